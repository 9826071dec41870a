#pragma once
#include <cstdint>
#include <vector>

#include "ct/hu_volume.hpp"
#include "ct/segment/humeral_head.hpp"
#include "ct/segment/shoulder_bones.hpp"

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

/// Spreads labels (0 is free) over the free voxels of at least `lowest_hu` that are face-connected to a
/// labelled one, the densest first: a watershed of the HU landscape from markers (Meyer 1994). Two bones
/// whose surfaces touch part along the valley of lower HU between them; a voxel goes to the label from which
/// the least deep valley leads to it. Ties go to who came first, so equal inputs give equal labels.
void flood_by_hu(const HuVolume& volume, double lowest_hu, std::vector<uint8_t>& labels);

/// Moves the border between the scapula and a bone that it touches to where the least bone is cut: the
/// minimum cut (Boykov and Kolmogorov 2004) of the voxels of both within `reach_mm` of the border, where
/// parting two neighbours costs their common face times how far they are above the threshold; marrow counts
/// as bone at the threshold, so that a hollow bone is not cut through its shell. A flood alone gives a whole
/// end plate to the wrong side when one dense bridge leads to it. Voxels farther off and those of `markers`
/// keep their labels. `labels` are changed in place; 1 is the scapula, other labels share one side.
void cut_at_necks(std::vector<uint8_t>& labels, const std::vector<uint8_t>& markers, const HuVolume& volume,
                  double threshold_hu, double reach_mm);

/// How a thresholded bone becomes a whole one.
struct WholeBoneSettings {
  double threshold_hu = 226.0;  ///< that the bone was made with
  double thin_bone_hu = 130.0;  ///< what is denser than soft tissue; pores at least this dense are closed
  double closing_mm = 2.5;      ///< half the width of pores and gaps that may be closed
};

/// Completes one bone of `labels` in place: free pieces above the threshold beside it (a blade so thin that
/// partial volume hides a band of it) and pores within a morphological closing where HU is at least
/// thin_bone_hu become bone; what is then not face-connected to its largest part becomes free; enclosed voids
/// are filled. Voxels of other labels stay theirs.
void make_whole(std::vector<uint8_t>& labels, const HuVolume& volume, BoneLabel label,
                const WholeBoneSettings& settings);

}  // namespace ream::ct
