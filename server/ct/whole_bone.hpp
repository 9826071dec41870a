#pragma once
#include "ct/shoulder_bones.hpp"

namespace ream::ct {

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
