#pragma once
#include "ct/shoulder_bones.hpp"

namespace ream::ct {

/// Moves the border between the scapula and a bone that it touches to where the least bone is cut: the
/// minimum cut (Boykov and Kolmogorov 2004) of the voxels of both within `reach_mm` of the border, where
/// parting two neighbours costs their common face times how far they are above the threshold; marrow counts
/// as bone at the threshold, so that a hollow bone is not cut through its shell. A flood alone gives a whole
/// end plate to the wrong side when one dense bridge leads to it. Voxels farther off and those of `markers`
/// keep their labels. `labels` are changed in place; 1 is the scapula, other labels share one side.
void cut_at_necks(std::vector<uint8_t>& labels, const std::vector<uint8_t>& markers, const HuVolume& volume,
                  double threshold_hu, double reach_mm);

}  // namespace ream::ct
