#pragma once
#include "ct/humeral_head.hpp"
#include "ct/shoulder_bones.hpp"

namespace ream::ct {

/// Humeral head of that side, or of the seed: of all good spheres the one farthest to that side. Empty when
/// there is none.
std::optional<HumeralHead> find_head(const HuVolume& volume, double threshold_hu, case_::Side side,
                                     const Seeds& seeds);

/// World box about a head that holds the scapula, whatever the person's size.
Aabb shoulder_box_mm(const HumeralHead& head, case_::Side side);

/// Labels (BoneLabel) of the voxels that are sure; 0 elsewhere. Without a head the seeds alone. Throws Error
/// invalid_input for a seed more than 5 mm from bone, or no bone where the glenoid must be.
std::vector<uint8_t> shoulder_markers(const HuVolume& volume, double threshold_hu,
                                      const std::optional<HumeralHead>& head, case_::Side side,
                                      const Seeds& seeds);

/// Mean of the scapula's voxels that face the head across the joint space, moved onto their distance from it;
/// empty when there are none.
std::optional<Vec3> glenoid_facing(const HumeralHead& head, case_::Side side, const HuVolume& volume,
                                   const std::vector<uint8_t>& labels);

}  // namespace ream::ct
