#pragma once
#include "ct/segment/shoulder_bones.hpp"

namespace ream::ct {

/// Values of a user's label map. Every other value but 0 is other bone.
struct LabelValues {
  int scapula = 1, humerus = 2, clavicle = 3;
};

/// The segmentation that a label map tells, of any geometry: each of the CT's voxels gets the value of the
/// map's voxel that holds its centre. `threshold_hu` is the suggestion for the CT. Throws Error invalid_input
/// when the map holds no scapula within the CT.
Segmentation segmentation_from_labels(const HuVolume& ct, const HuVolume& map,
                                      const LabelValues& values = {});

}  // namespace ream::ct
