#include "ct/segment/threshold_suggestion.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "unit/ct/shoulder_phantom.hpp"

namespace ream::ct {
namespace {

TEST(ThresholdSuggestion, LimitsLieBetweenThreePeaks) {
  std::vector<size_t> counts(100);
  counts[10] = 900, counts[40] = 300, counts[85] = 200;
  const auto limits = three_class_limits(counts);
  EXPECT_GT(limits[0], 10u);
  EXPECT_LE(limits[0], 40u);
  EXPECT_GT(limits[1], 40u);
  EXPECT_LE(limits[1], 85u);
}

TEST(ThresholdSuggestion, LimitsAreTheBestOfAll) {
  // By the definition: the pair with the least variance within the classes, tried one by one.
  const std::vector<size_t> counts{5, 9, 14, 6, 2, 3, 7, 12, 4, 1, 2, 6, 11, 8};
  const auto within = [&](size_t from, size_t to) {
    double n = 0, sum = 0, squares = 0;
    for (size_t i = from; i < to; ++i) {
      const auto c = static_cast<double>(counts[i]), x = static_cast<double>(i);
      n += c, sum += c * x, squares += c * x * x;
    }
    return squares - sum * sum / n;
  };
  double least = 1e300;
  for (size_t i = 1; i + 1 < counts.size(); ++i)
    for (size_t j = i + 1; j < counts.size(); ++j)
      least = std::min(least, within(0, i) + within(i, j) + within(j, counts.size()));
  const auto [i, j] = three_class_limits(counts);
  EXPECT_NEAR(within(0, i) + within(i, j) + within(j, counts.size()), least, 1e-9);
}

TEST(ThresholdSuggestion, HoldsFromQuietToNoisy) {
  for (const double noise_hu : {0.0, 10.0, 25.0, 45.0}) {
    const HuVolume volume = make_phantom(shoulder_params(case_::Side::right, 4.0, noise_hu)).volume;
    const double threshold = suggested_threshold_hu(volume);
    // Soft tissue is 50 HU, the phantom's bone begins at 300 HU.
    EXPECT_GE(threshold, 50.0 + 3.5 * noise_hu) << noise_hu;
    EXPECT_LE(threshold, 300.0) << noise_hu;
    if (noise_hu >= 10.0) {
      EXPECT_NEAR(soft_tissue_of(volume).deviation_hu, noise_hu, 0.25 * noise_hu);
    }
  }
}

TEST(ThresholdSuggestion, AirAndASingleValueGiveTheCustomaryOne) {
  HuVolume volume;
  volume.dims = Vec3i::Constant(8);
  volume.hu.assign(512, -1000);
  EXPECT_EQ(suggested_threshold_hu(volume), 226.0);
  volume.hu.assign(512, 60);
  EXPECT_EQ(suggested_threshold_hu(volume), 226.0);
}

}  // namespace
}  // namespace ream::ct
