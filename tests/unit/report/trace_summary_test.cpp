#include "report/trace_summary.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "support/random_pose.hpp"
#include "support/seed.hpp"

namespace ream::report {
namespace {

record::TickReport tick(const Pose& world_from_plan, bool engaged, double thrust_n, double axial_mm) {
  record::TickReport r;
  r.engaged = r.cutting = engaged;
  r.thrust_n = thrust_n;
  r.feed_rate_mm_s = 0.01 * thrust_n;
  r.world_from_tool = world_from_plan * Pose{Mat3::Identity(), Vec3(0.2, 0.1, axial_mm)};
  return r;
}

TEST(TraceSummary, HoldsExtremesOfEveryPart) {
  std::mt19937 random(test::seed(31));
  const Pose world_from_plan = test::random_pose(random);
  std::uniform_real_distribution<double> thrust(0.0, 90.0);
  for (const uint32_t ticks : {1u, 719u, 720u, 721u, 5000u, 100'003u}) {
    TraceSummary trace(ticks, world_from_plan.inverse());
    double highest = 0.0, lowest = 1e9, deepest = 0.0;
    for (uint32_t i = 0; i < ticks; ++i) {
      const double n = thrust(random), mm = 0.05 * thrust(random);
      highest = std::max(highest, n);
      lowest = std::min(lowest, n);
      if (i == 0) deepest = mm;
      trace.add(tick(world_from_plan, true, n, mm));
      deepest = std::max(deepest, mm);
    }
    EXPECT_LE(trace.bins().size(), TraceSummary::max_bins);
    EXPECT_NEAR(trace.duration_s(), ticks * 1e-3, 1e-9);
    EXPECT_GE(static_cast<double>(trace.bins().size()) * trace.bin_s(), trace.duration_s() - 1e-9);
    double high = 0.0, low = 1e9, feed = 0.0;
    for (const TraceBin& bin : trace.bins()) {
      high = std::max(high, bin.thrust_high_n);
      low = std::min(low, bin.thrust_low_n);
      feed = std::max(feed, bin.feed_high_mm_s);
    }
    EXPECT_EQ(high, highest);
    EXPECT_EQ(low, lowest);
    EXPECT_EQ(feed, 0.01 * highest);
  }
}

TEST(TraceSummary, DepthCountsFromFirstContactInTheBone) {
  std::mt19937 random(test::seed(32));
  const Pose world_from_plan = test::random_pose(random);
  TraceSummary trace(4, world_from_plan.inverse());
  trace.add(tick(world_from_plan, false, 0.0, -7.0));
  for (const double axial_mm : {1.5, 3.25, 2.0}) {
    record::TickReport r = tick(world_from_plan, true, 40.0, axial_mm);
    r.world_from_bone_rest = test::random_pose(random, 5.0);
    r.world_from_tool = r.world_from_bone_rest * r.world_from_tool;
    trace.add(r);
  }
  EXPECT_FALSE(trace.bins()[0].depth_mm);
  EXPECT_FALSE(trace.bins()[0].touched);
  EXPECT_NEAR(trace.bins()[1].depth_mm.value(), 0.0, 1e-9);
  EXPECT_NEAR(trace.bins()[2].depth_mm.value(), 1.75, 1e-9);
  EXPECT_NEAR(trace.deepest_mm(), 1.75, 1e-9);
}

TEST(TraceSummary, NothingIsNothing) {
  const TraceSummary trace(0, Pose{});
  EXPECT_TRUE(trace.bins().empty());
  EXPECT_EQ(trace.duration_s(), 0.0);
}

}  // namespace
}  // namespace ream::report
