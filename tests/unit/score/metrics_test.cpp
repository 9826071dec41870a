#include "score/metrics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "support/seed.hpp"
#include "support/tick_reports.hpp"

namespace ream::score {
namespace {

using record::TickReport;

/// In contact with the tool's apex so deep along the plan's axis, removing unless told otherwise.
TickReport contact(const Pose& world_from_plan, double axial_mm, double thrust_n, bool removing = true) {
  TickReport r;
  r.engaged = r.spindle_on = true;
  r.world_from_tool = world_from_plan * Pose{Mat3::Identity(), Vec3(0.3, -0.2, axial_mm)};
  r.thrust_n = thrust_n;
  r.changed_bricks = removing ? 1 : 0;
  return r;
}

TickReport in_the_air(const Pose& world_from_plan, double axial_mm) {
  TickReport r = contact(world_from_plan, axial_mm, 0.0, false);
  r.engaged = false;
  return r;
}

TEST(Metrics, NothingHappenedIsAllZero) {
  MetricsAccumulator accumulator(0.008, Pose{});
  const MetricResults m = accumulator.results();
  for (const double value : {*m.value("removed_volume_mm3"), *m.value("axial_thrust_peak_n"),
                             *m.value("duration_s"), *m.value("contact_time_s"), *m.value("idle_time_s")})
    EXPECT_EQ(value, 0.0);
  EXPECT_FALSE(m.value("axial_thrust_mean_n")) << "a mean of nothing";
}

TEST(Metrics, VolumesAddUpByClass) {
  MetricsAccumulator accumulator(0.5, Pose{});
  TickReport r;
  r.coverage_removed[static_cast<size_t>(voxel::BoneClass::cancellous)] = 255;
  r.coverage_removed[static_cast<size_t>(voxel::BoneClass::cortical)] = 510;
  r.coverage_removed[static_cast<size_t>(voxel::BoneClass::cartilage)] = 51;
  for (int i = 0; i < 3; ++i) accumulator.add(r);
  const MetricResults m = accumulator.results();
  EXPECT_DOUBLE_EQ(*m.value("removed_volume_cancellous_mm3"), 1.5);
  EXPECT_DOUBLE_EQ(*m.value("removed_volume_cortical_mm3"), 3.0);
  EXPECT_DOUBLE_EQ(*m.value("removed_volume_cartilage_mm3"), 0.3);
  EXPECT_DOUBLE_EQ(*m.value("removed_volume_mm3"), 4.8);
}

TEST(Metrics, MeanThrustIsOfPressedCuttingPeakOfContactWithTheSpindleOn) {
  MetricsAccumulator accumulator(0.008, Pose{});
  accumulator.add(in_the_air(Pose{}, -1.0));
  for (const double thrust_n : {10.0, 40.0, 25.0}) {
    TickReport cut = contact(Pose{}, 0.0, thrust_n);
    cut.cutting = true;
    accumulator.add(cut);
  }
  TickReport light = contact(Pose{}, 0.0, 4.9);
  light.cutting = true;
  accumulator.add(light);
  accumulator.add(contact(Pose{}, 0.0, 50.0));  // pressed, and too little to cut
  TickReport resting = contact(Pose{}, 0.0, 90.0, false);
  resting.spindle_on = false;
  accumulator.add(resting);
  const MetricResults m = accumulator.results();
  EXPECT_DOUBLE_EQ(*m.value("axial_thrust_mean_n"), 25.0);
  EXPECT_NEAR(*m.value("axial_thrust_sd_n"), std::sqrt(150.0), 1e-6) << "of 10, 40 and 25 N";
  EXPECT_DOUBLE_EQ(*m.value("axial_thrust_peak_n"), 50.0);
  EXPECT_DOUBLE_EQ(*m.value("duration_s"), 7e-3);
  EXPECT_DOUBLE_EQ(*m.value("contact_time_s"), 6e-3);
}

/// Thrust and advance of a straight line: `steps` ticks from (from_n, from_mm) to (to_n, to_mm).
void rise(MetricsAccumulator& accumulator, double from_n, double to_n, double from_mm, double to_mm,
          int steps) {
  for (int i = 0; i <= steps; ++i) {
    const double part = static_cast<double>(i) / steps;
    accumulator.add(contact(Pose{}, from_mm + part * (to_mm - from_mm), from_n + part * (to_n - from_n)));
  }
}

TEST(Metrics, ApparentStiffnessIsTheSlopeOfTheFirstRise) {
  MetricsAccumulator accumulator(0.008, Pose{});
  accumulator.add(in_the_air(Pose{}, -1.0));
  EXPECT_FALSE(accumulator.results().value("apparent_stiffness_n_mm"));
  // A first try that lets go again, deep; then 60 N a mm; then anything.
  rise(accumulator, 0.0, 40.0, 0.0, 3.0, 10);
  accumulator.add(contact(Pose{}, 3.0, 0.4));
  EXPECT_FALSE(accumulator.results().value("apparent_stiffness_n_mm"));
  rise(accumulator, 0.0, 60.0, 3.0, 4.0, 600);
  rise(accumulator, 60.0, 90.0, 4.0, 9.0, 10);
  rise(accumulator, 0.0, 90.0, 9.0, 9.5, 10);
  EXPECT_NEAR(*accumulator.results().value("apparent_stiffness_n_mm"), 60.0, 1e-9);
}

TEST(Metrics, ApparentStiffnessNeedsASpinningToolThatAdvances) {
  MetricsAccumulator jump(0.008, Pose{});
  jump.add(contact(Pose{}, 1.0, 50.0));
  rise(jump, 0.0, 52.0, 1.0, 2.0, 10);
  EXPECT_FALSE(jump.results().value("apparent_stiffness_n_mm")) << "the first rise was all at once";
  MetricsAccumulator standing(0.008, Pose{});
  for (int i = 0; i < 60; ++i) {
    TickReport r = contact(Pose{}, 0.01 * i, i);
    r.spindle_on = false;
    standing.add(r);
  }
  EXPECT_FALSE(standing.results().value("apparent_stiffness_n_mm"));
}

TEST(Metrics, HashIsTheLastTicks) {
  std::mt19937 random(test::seed(42));
  MetricsAccumulator accumulator(0.008, Pose{});
  TickReport last;
  for (uint32_t tick = 0; tick < 5; ++tick) accumulator.add(last = test::random_report(random, tick));
  EXPECT_EQ(accumulator.session_hash(), last.session_hash);
}

TEST(Metrics, EqualRunsGiveEqualBytes) {
  const auto text = [] {
    std::mt19937 random(test::seed(43));
    MetricsAccumulator accumulator(0.008, Pose{});
    for (uint32_t tick = 0; tick < 500; ++tick) accumulator.add(test::random_report(random, tick));
    return session_metrics_json(accumulator, {}, 26.0, nullptr).dump();
  };
  EXPECT_EQ(text(), text());
}

TEST(MetricsJson, HasTheKeysThatScriptsRelyOn) {
  MetricsAccumulator accumulator(0.5, Pose{});
  TickReport r;
  r.coverage_removed[static_cast<size_t>(voxel::BoneClass::cancellous)] = 25 * 255;
  r.session_hash = 0x1234;
  accumulator.add(r);
  const uint64_t grid_hash = 0xabcdef;
  const nlohmann::json json = session_metrics_json(accumulator, {}, 26.0, &grid_hash);
  for (const char* key :
       {"removed_volume_mm3", "removed_volume_cortical_mm3", "removed_volume_cancellous_mm3",
        "axial_thrust_peak_n", "duration_s", "force_scale"}) {
    ASSERT_TRUE(json.contains(key)) << key;
    EXPECT_TRUE(json[key].is_number()) << key;
  }
  EXPECT_EQ(json["removed_volume_mm3"], 12.5);
  EXPECT_EQ(json["force_scale"], 26.0);
  EXPECT_EQ(json["session_hash"], "0000000000001234");
  EXPECT_EQ(json["grid_hash"], "0000000000abcdef");
  EXPECT_FALSE(json.contains("tick_us")) << "wall times differ between equal runs";
}

TEST(MetricsJson, ApparentStiffnessIsNullUntilItIsReached) {
  MetricsAccumulator accumulator(0.008, Pose{});
  const auto stiffness = [&] {
    return session_metrics_json(accumulator, {}, 1.0, nullptr).at("apparent_stiffness_n_mm");
  };
  EXPECT_TRUE(stiffness().is_null());
  rise(accumulator, 0.0, 60.0, 3.0, 4.0, 600);
  EXPECT_NEAR(stiffness().get<double>(), 60.0, 1e-9);
}

TEST(MetricsJson, GridHashIsNullWhileTheRunGoesOn) {
  const nlohmann::json json = session_metrics_json(MetricsAccumulator(0.008, Pose{}), {}, 1.0, nullptr);
  ASSERT_TRUE(json.contains("grid_hash"));
  EXPECT_TRUE(json["grid_hash"].is_null());
}

}  // namespace
}  // namespace ream::score
