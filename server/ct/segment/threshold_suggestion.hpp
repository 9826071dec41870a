#pragma once
#include <array>
#include <vector>

#include "ct/hu_volume.hpp"

namespace ream::ct {

/// A threshold between soft tissue and bone, HU, from the histogram of the CT: the lower of the two Otsu
/// thresholds that part the values from 0 to 2000 HU into soft tissue, spongy and compact bone (Otsu 1979),
/// but at least four standard deviations of soft tissue above its most frequent value, so that noise stays
/// out; within 100 to 500 HU, whole. A CT without values in that range gives 226 HU, a customary threshold of
/// bone.
double suggested_threshold_hu(const HuVolume& volume);

/// What the lower limit of the suggestion is made of: the most frequent value of soft tissue (0 to 150 HU)
/// and its standard deviation, from where the histogram has fallen to half above that value; HU.
struct SoftTissue {
  double hu = 40.0, deviation_hu = 0.0;
};
SoftTissue soft_tissue_of(const HuVolume& volume);

/// The first bins of the second and third class when a histogram is parted into three classes with the
/// greatest variance between them (Otsu 1979, IEEE Trans. SMC 9:62-66, section IV). Needs counts in three
/// bins.
std::array<size_t, 2> three_class_limits(const std::vector<size_t>& counts);

}  // namespace ream::ct
