#include <gtest/gtest.h>

#include "score/metrics.hpp"
#include "support/seed.hpp"
#include "support/tick_reports.hpp"

namespace ream::score {
namespace {

using record::TickReport;
using voxel::BoneClass;

/// Pressing at a depth on bone of which these shares are cancellous, cortical and cartilage.
TickReport pressing(double axial_mm, double thrust_n, double cancellous, double cortical,
                    double cartilage = 0.0) {
  TickReport r;
  r.engaged = r.spindle_on = true;
  r.world_from_tool.translation_mm = Vec3(0, 0, axial_mm);
  r.thrust_n = thrust_n;
  r.share[static_cast<size_t>(BoneClass::cancellous)] = cancellous;
  r.share[static_cast<size_t>(BoneClass::cortical)] = cortical;
  r.share[static_cast<size_t>(BoneClass::cartilage)] = cartilage;
  return r;
}

TickReport in_the_air() { return {}; }

void repeat(MetricsAccumulator& metrics, const TickReport& report, int ticks) {
  for (int i = 0; i < ticks; ++i) metrics.add(report);
}

TEST(Handling, ExcessIsThrustBeyond78N) {
  MetricsAccumulator metrics(0.008, Pose{});
  repeat(metrics, pressing(0.0, 60.0, 0, 1), 100);
  repeat(metrics, pressing(0.0, 98.0, 0, 1), 500);
  TickReport standing = pressing(0.0, 200.0, 0, 1);
  standing.spindle_on = false;
  repeat(metrics, standing, 100);
  EXPECT_NEAR(*metrics.results().value("axial_thrust_excess_n_s"), 10.0, 1e-9);
}

TEST(Handling, BreakthroughIsFromCancellousBoneToLettingGo) {
  MetricsAccumulator metrics(0.008, Pose{});
  repeat(metrics, pressing(0.5, 52.0, 0.05, 0.95), 100);
  EXPECT_NE(metrics.results().missing_reason("breakthrough_advance_mm").find("no cancellous"),
            std::string::npos);
  for (int i = 0; i < 300; ++i) metrics.add(pressing(1.0 + 0.001 * i, 40.0, 0.3, 0.7));
  EXPECT_NE(metrics.results().missing_reason("breakthrough_time_s").find("not fallen"), std::string::npos);
  metrics.add(pressing(1.31, 3.0, 0.3, 0.7));
  repeat(metrics, in_the_air(), 100);
  for (int i = 0; i < 300; ++i) metrics.add(pressing(2.0 + 0.01 * i, 40.0, 0.3, 0.7));
  EXPECT_NEAR(*metrics.results().value("breakthrough_advance_mm"), 0.31, 1e-6);
  EXPECT_NEAR(*metrics.results().value("breakthrough_time_s"), 0.3, 1e-6);
}

TEST(Handling, ATouchThatDoesNotPressIsNoBreakthrough) {
  MetricsAccumulator metrics(0.008, Pose{});
  repeat(metrics, pressing(0.5, 4.0, 1.0, 0.0), 100);
  EXPECT_FALSE(metrics.results().value("breakthrough_advance_mm"));
}

TEST(Handling, AdvancePastThePlateNeedsCartilage) {
  MetricsAccumulator without(0.008, Pose{});
  repeat(without, pressing(0.5, 52.0, 0.0, 1.0), 100);
  EXPECT_NE(without.results().missing_reason("plate_overrun_mm").find("no cartilage"), std::string::npos);

  MetricsAccumulator with(0.008, Pose{});
  repeat(with, pressing(0.1, 20.0, 0.0, 0.0, 1.0), 100);
  EXPECT_NE(with.results().missing_reason("plate_overrun_mm").find("not reached"), std::string::npos);
  for (int i = 0; i <= 400; ++i) with.add(pressing(1.9 + 0.001 * i, 40.0, 0.0, 0.4, 0.6));
  with.add(in_the_air());
  EXPECT_NEAR(*with.results().value("plate_overrun_mm"), 0.4, 1e-6);
}

TEST(Handling, PassesArePartedByHalfASecond) {
  MetricsAccumulator metrics(0.008, Pose{});
  EXPECT_EQ(*metrics.results().value("passes"), 0.0);
  repeat(metrics, pressing(0.0, 20.0, 0, 1), 100);
  repeat(metrics, in_the_air(), 500);
  repeat(metrics, pressing(0.0, 20.0, 0, 1), 100);
  EXPECT_EQ(*metrics.results().value("passes"), 1.0);
  repeat(metrics, pressing(0.0, 5.0, 0, 1), 501);
  repeat(metrics, pressing(0.0, 20.0, 0, 1), 100);
  EXPECT_EQ(*metrics.results().value("passes"), 2.0);
}

TEST(Handling, PathIsInTheBoneThatMoves) {
  std::mt19937 random(test::seed(8));
  MetricsAccumulator metrics(0.008, Pose{});
  for (int i = 0; i <= 100; ++i) {
    TickReport r = pressing(0.01 * i, 20.0, 0, 1);
    r.world_from_bone_rest = test::random_pose(random, 5.0);
    r.world_from_tool = r.world_from_bone_rest * r.world_from_tool;
    metrics.add(r);
  }
  EXPECT_NEAR(*metrics.results().value("path_in_contact_mm"), 1.0, 1e-6);
}

}  // namespace
}  // namespace ream::score
