#include "score/heating.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/clock.hpp"

namespace ream::score {
namespace {

const char* const heat_keys[] = {"surface_temperature_peak_c", "time_over_47_s", "time_over_56_s",
                                 "heated_bone_depth_mm"};

MetricResults written(const Heating& heating) {
  MetricResults results;
  heating.write(results);
  return results;
}

record::TickReport at(double surface_c, double feed_mm_s = 0.0) {
  record::TickReport r;
  r.surface_temperature_c = surface_c;
  r.cutting = feed_mm_s > 0.0;
  r.feed_rate_mm_s = feed_mm_s;
  return r;
}

TEST(Heating, IsMissingWhereItWasNotSimulated) {
  Heating heating;
  for (int i = 0; i < 100; ++i) heating.add({});
  for (const char* key : heat_keys) {
    EXPECT_FALSE(written(heating).value(key)) << key;
    EXPECT_NE(written(heating).missing_reason(key).find("not simulated"), std::string::npos) << key;
  }
}

TEST(Heating, CountsTimeAtTheSurface) {
  Heating heating;
  for (const double c : {35.0, 46.9, 47.0, 55.9, 56.0, 61.5, 40.0})
    for (int i = 0; i < 250; ++i) heating.add(at(c));
  EXPECT_DOUBLE_EQ(*written(heating).value(heat_keys[0]), 61.5);
  EXPECT_NEAR(*written(heating).value(heat_keys[1]), 1.0, 1e-9);
  EXPECT_NEAR(*written(heating).value(heat_keys[2]), 0.5, 1e-9);
}

/// Of a half space whose surface is held at `surface_c` for a time: 35 + rise erfc(x / (2 sqrt(a t))).
double depth_of_56_mm(double surface_c, double seconds) {
  const double spread_mm = 2.0 * std::sqrt(0.5 / 2.6 * seconds);
  double low = 0.0, high = 10.0;
  for (int i = 0; i < 60; ++i) {
    const double x = 0.5 * (low + high);
    (35.0 + (surface_c - 35.0) * std::erfc(x / spread_mm) > 56.0 ? low : high) = x;
  }
  return low;
}

TEST(Heating, DepthFollowsFromTheSurface) {
  for (const double c : {60.0, 75.0, 90.0}) {
    Heating heating;
    for (int i = 0; i < 30'000; ++i) heating.add(at(c));
    EXPECT_NEAR(*written(heating).value(heat_keys[3]), depth_of_56_mm(c, 30.0), 0.02) << c;
  }
}

TEST(Heating, HeatedBoneThatIsReamedAwayIsNoneButElsewhereItStays) {
  Heating heating;
  for (int i = 0; i < 30'000; ++i) heating.add(at(75.0));
  const double depth_mm = *written(heating).value(heat_keys[3]);
  for (int i = 0; i < 1000; ++i) heating.add(at(45.0, 0.5));
  EXPECT_NEAR(*written(heating).value(heat_keys[3]), depth_mm - 0.5, 0.02);
  heating.add(at(35.0));
  for (int i = 0; i < 4000; ++i) heating.add(at(45.0, 0.5));
  EXPECT_NEAR(*written(heating).value(heat_keys[3]), depth_mm - 0.5, 0.02)
      << "the other place was not reamed";
}

/// What a simulation has reached is what its ticks tell.
TEST(Heating, FindsTheDepthThatWasSimulated) {
  force::HeatedBone simulated;
  Heating heating;
  force::HeatTick tick;
  for (int i = 0; i < 60'000; ++i) {
    const bool cuts = i % 9000 < 7000;
    tick.power_w = cuts ? 14.0 : 0.0;
    tick.area_mm2 = 600.0;
    tick.irrigated = i > 45'000;
    const double feed_mm_s = cuts ? 0.04 : 0.0;
    tick.advance_mm = feed_mm_s * tick_s;
    simulated.add({}, tick);
    heating.add(at(static_cast<float>(simulated.surface_c({})), feed_mm_s));
  }
  EXPECT_GT(simulated.column().dead_depth_mm(), 0.5);
  EXPECT_NEAR(*written(heating).value(heat_keys[3]), simulated.column().dead_depth_mm(), 0.02);
}

}  // namespace
}  // namespace ream::score
