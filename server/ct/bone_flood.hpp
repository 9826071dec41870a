#pragma once
#include <cstdint>
#include <vector>

#include "ct/hu_volume.hpp"

namespace ream::ct {

/// Spreads labels (0 is free) over the free voxels of at least `lowest_hu` that are face-connected to a
/// labelled one, the densest first: a watershed of the HU landscape from markers (Meyer 1994). Two bones
/// whose surfaces touch part along the valley of lower HU between them; a voxel goes to the label from which
/// the least deep valley leads to it. Ties go to who came first, so equal inputs give equal labels.
void flood_by_hu(const HuVolume& volume, double lowest_hu, std::vector<uint8_t>& labels);

}  // namespace ream::ct
