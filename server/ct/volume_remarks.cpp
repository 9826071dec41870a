#include "ct/volume_remarks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace ream::ct {
namespace {

constexpr int sampled_rows = 512;
constexpr int64_t smoother_factor = 4;
constexpr int64_t suspicious_step = 100;  // mean step between neighbours, of which no CT comes near

}  // namespace

void remark_thickness(HuVolume& volume, double thickness_mm) {
  const double thickest = std::max(volume.spacing_mm.maxCoeff(), thickness_mm);
  if (thickest < thick_slice_mm) return;
  // Worst of 12 phantoms, as thick_slices_test.cpp measures them.
  const bool coarse = thickest > 6.5;
  const char* inclination = coarse ? "4.5" : "3.6";
  const char* merged = coarse ? "half" : "a quarter";
  char text[400];
  std::snprintf(
      text, sizeof text,
      "the slices are %.3g mm thick: phantoms of %s mm had the glenoid's face up to 2 mm off in depth and "
      "%s degrees in inclination, and up to %s of it ran together with the humerus (1 mm slices: 0.7 mm "
      "and 0.5 degrees); version stays within 0.6 degrees; plan on slices of 1.25 mm or finer",
      thickest, coarse ? "8" : "5", inclination, merged);
  volume.warnings.emplace_back(text);
}

void remark_gray_values(HuVolume& volume) {
  if (volume.hu.empty()) return;
  const auto [low, high] = std::minmax_element(volume.hu.begin(), volume.hu.end());
  if (*low < 0) return;
  if (*high <= 255) {
    volume.warnings.push_back("the values run from " + std::to_string(*low) + " to " + std::to_string(*high) +
                              ": these are gray values, not HU; threshold and calibration must be chosen for "
                              "them");
    return;
  }
  // Air near 0 and soft tissue near 1000 in one volume.
  const auto count = [&](int from, int to) {
    const auto n =
        std::count_if(volume.hu.begin(), volume.hu.end(), [&](int16_t v) { return v >= from && v < to; });
    return static_cast<double>(n) / static_cast<double>(volume.hu.size());
  };
  if (count(0, 200) > 0.05 && count(900, 1200) > 0.05)
    volume.warnings.push_back(
        "the values look like HU raised by about 1024 (air at 0, soft tissue at 1000); export the CT again "
        "with "
        "its rescaling, or choose threshold and calibration for them");
}

bool looks_byte_swapped(const HuVolume& volume) {
  const int64_t rows = static_cast<int64_t>(volume.dims.y()) * volume.dims.z(), width = volume.dims.x();
  const int64_t stride = std::max<int64_t>(1, rows / sampled_rows);
  int64_t as_is = 0, swapped = 0, steps = 0;
  const auto turned = [](int16_t v) {
    const auto bits = static_cast<uint16_t>(v);
    return static_cast<int16_t>(static_cast<uint16_t>(bits << 8 | bits >> 8));
  };
  for (int64_t row = 0; row < rows; row += stride)
    for (int64_t u = 1; u < width; ++u) {
      const int16_t a = volume.hu[static_cast<size_t>(row * width + u - 1)],
                    b = volume.hu[static_cast<size_t>(row * width + u)];
      as_is += std::abs(a - b);
      swapped += std::abs(turned(a) - turned(b));
      ++steps;
    }
  return steps > 0 && as_is > suspicious_step * steps && as_is > smoother_factor * swapped;
}

}  // namespace ream::ct
