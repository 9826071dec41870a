#include <gtest/gtest.h>

#include "force/coefficients.hpp"
#include "support/small_run.hpp"

namespace ream::test {
namespace {

constexpr double robot_surface_mm = 9.0;

SmallRun on_slab(const device::Script& script, double density_g_cc) {
  voxel::BoneModel bone = slab({96, 96, 96}, 0.15, robot_surface_mm, density_g_cc);
  const case_::Plan plan = slab_plan(bone, robot_surface_mm);
  return SmallRun(std::move(bone), plan, "sphere 8,5", script);
}

device::Script robot(double depth_mm) {
  device::Script script;
  script.kind = device::ScriptKind::robot;
  script.device_profile = "ideal-admittance";
  script.duration_s = 60.0;
  script.robot.start_mm = Vec3(0, 0, -1);
  script.robot.depth_mm = depth_mm;
  return script;
}

double apex_mm(const SmallRun& run, const record::TickReport& report) {
  return run.model.world_from_plan.inverse().point(report.world_from_tool.translation_mm).z();
}

TEST(RobotProtocol, RampsToItsForceReachesItsDepthAndComesBack) {
  // Counted from where bone is first felt, a voxel ahead of where it is cut.
  SmallRun run = on_slab(robot(0.75), 0.5);
  const auto reports = run.run();
  ASSERT_LT(reports.size(), 60000u) << "it ends by itself";
  double deepest_mm = 0.0, touched_mm = 0.0;
  int64_t held_ticks = 0;
  for (const auto& r : reports) {
    if (r.engaged && touched_mm == 0.0) touched_mm = apex_mm(run, r);
    deepest_mm = std::max(deepest_mm, apex_mm(run, r));
    ASSERT_LE(r.thrust_n, 52.0 + 0.5) << "tick " << r.tick;
    if (r.thrust_n < 51.99) continue;
    ++held_ticks;
    ASSERT_NEAR(r.feed_rate_mm_s, -0.34 * 0.5 + 0.42, 0.02 * 0.25) << "tick " << r.tick;
  }
  EXPECT_NEAR(deepest_mm - touched_mm, 0.75, 0.03);
  EXPECT_GT(held_ticks, 1000);
  EXPECT_NEAR(apex_mm(run, reports.back()), -1.0, 0.02);
  EXPECT_FALSE(reports.back().engaged);
}

TEST(RobotProtocol, HandsFeedAlikeOnBothKindsOfDevice) {
  for (const double density_g_cc : {0.5, 1.5}) {
    double feed_mm_s[2];
    for (const bool admittance : {false, true}) {
      device::Script script = steady_push(52.0, 2.5);
      if (admittance) script.device_profile = "ideal-admittance";
      SmallRun run = on_slab(script, density_g_cc);
      const auto reports = run.run();
      ASSERT_EQ(reports.size(), 2500u);
      feed_mm_s[admittance] = apex_mm(run, reports.back()) - apex_mm(run, reports[1499]);
    }
    EXPECT_NEAR(feed_mm_s[1], feed_mm_s[0], 0.01 * feed_mm_s[0]) << density_g_cc << " g/cc";
  }
}

}  // namespace
}  // namespace ream::test
