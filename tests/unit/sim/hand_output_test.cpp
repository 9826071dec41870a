#include "sim/hand_output.hpp"

#include <gtest/gtest.h>

#include "support/small_run.hpp"

namespace ream::test {
namespace {

/// A model whose device is a small one, for rendering loads that the test makes up.
struct Rendering {
  Rendering() : run(slab({32, 32, 32}, 0.5, 8.0, 0.6), plan(), "sphere 6,4", steady_push(1.0, 1.0)) {
    sim::Settings& s = run.model.settings;
    s.force_scale = 10.0;
    sim::fit_to_device(device::device_profile("premium-1.5-6dof"), 0.8, s);
    run.model.coupling = {s.stiffness_n_mm, s.angular_stiffness_n_mm_rad, s.force_scale};
  }

  static case_::Plan plan() { return slab_plan(slab({32, 32, 32}, 0.5, 8.0, 0.6), 8.0); }

  record::TickReport tick(sim::HandOutput& output, double thrust_n, double spindle_n_mm, double vibration_g,
                          bool paused = false, bool stale = false) {
    sim::ToolLoad load;
    load.spring.force_n = Vec3(0, 0, thrust_n);
    load.unlimited_force_n = thrust_n / run.model.settings.force_scale;
    record::TickReport report;
    report.spindle_torque_n_mm = spindle_n_mm;
    report.vibration_g = vibration_g;
    report.paused = paused;
    report.stale = stale;
    // A hand that keeps pressing has put in what contact may ask back.
    report.world_from_handle.translation_mm.z() = depth_mm += 0.01;
    sim::render(run.model, output, Pose{}, load, report);
    return report;
  }

  SmallRun run;
  double depth_mm = 0.0;
};

TEST(HandOutput, RampsUpAfterTheStartAndAfterAPause) {
  Rendering r;
  sim::HandOutput output(0.1);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(r.tick(output, 0.0, 0.0, 0.0).hand_force_n.norm(), 0.0);
  double previous_n = 0.0;
  for (int i = 0; i < 150; ++i) {
    const double now_n = r.tick(output, 20.0, 0.0, 0.0).hand_force_n.norm();
    EXPECT_GE(now_n, previous_n);
    EXPECT_LE(now_n - previous_n, r.run.model.settings.limits.force_slew_n + 1e-12);
    previous_n = now_n;
  }
  EXPECT_NEAR(previous_n, 2.0, 1e-9);
  EXPECT_EQ(r.tick(output, 20.0, 100.0, 1.0, true).hand_force_n.norm(), 0.0);
  EXPECT_EQ(r.tick(output, 20.0, 0.0, 0.0).hand_force_n.norm(), 0.0) << "waits for a small force again";
}

TEST(HandOutput, AStalePosesForceFallsThoughTheLoadRises) {
  Rendering r;
  sim::HandOutput output(0.0);
  double before_n = 0.0;
  for (int i = 0; i < 100; ++i) before_n = r.tick(output, 20.0, 0.0, 0.0).hand_force_n.norm();
  EXPECT_NEAR(before_n, 2.0, 1e-9);
  for (int i = 1; i <= 20; ++i)
    EXPECT_LE(r.tick(output, 20.0 + 5.0 * i, 0.0, 0.0, false, true).hand_force_n.norm(),
              before_n * (1.0 - i / 20.0) + 1e-9)
        << "stale for " << i;
}

/// The loop's own thread stood still for so long that hand and device both let go, and the pose is old too.
TEST(HandOutput, AStalePosesForceDoesNotComeBackAfterATickOfRest) {
  Rendering r;
  sim::HandOutput output(0.0);
  for (int rest = 1; rest <= 20; ++rest) {
    for (int i = 0; i < 100; ++i) r.tick(output, 20.0, 100.0, 0.0);
    ASSERT_NEAR(output.contact.force_n.norm(), 2.0, 1e-9);
    for (int i = 1; i < rest; ++i) r.tick(output, 20.0, 100.0, 0.0, false, true);
    r.tick(output, 20.0, 100.0, 1.0, true, true);
    for (int i = 0; i < 30; ++i) {
      const auto report = r.tick(output, 20.0, 100.0, 1.0, false, true);
      EXPECT_EQ(report.hand_force_n.norm(), 0.0) << i << " after rest in tick " << rest;
      EXPECT_EQ(report.hand_torque_n_mm.norm(), 0.0) << i << " after rest in tick " << rest;
    }
  }
}

TEST(HandOutput, VibrationHasALimitOfItsOwnAndStaysWithinTheDevices) {
  Rendering r;
  const auto& settings = r.run.model.settings;
  sim::HandOutput output(0.0);
  for (int i = 0; i < 100; ++i) r.tick(output, 50.0, 0.0, 0.0);
  const double gentle_n = r.tick(output, 50.0, 0.0, -1.0).hand_force_n.norm();
  EXPECT_NEAR(gentle_n, 5.0 + settings.vibration.vibration_n_per_g, 1e-9);
  const double strong_n = r.tick(output, 50.0, 0.0, -1000.0).hand_force_n.norm();
  EXPECT_NEAR(strong_n, 5.0 + settings.vibration.vibration_max_n, 1e-9);
  for (int i = 0; i < 100; ++i) r.tick(output, 500.0, 0.0, 0.0);
  EXPECT_NEAR(r.tick(output, 500.0, 0.0, -1000.0).hand_force_n.norm(), settings.limits.force_max_n, 1e-9);
}

TEST(HandOutput, TheSpindlesReactionTakesWhatTorqueContactLeaves) {
  Rendering r;
  sim::HandOutput output(0.0);
  record::TickReport report;
  for (int i = 0; i < 200; ++i) report = r.tick(output, 50.0, 900.0, 0.0);
  EXPECT_NEAR(report.hand_torque_n_mm.z(), -90.0, 1e-9);
  for (int i = 0; i < 200; ++i) report = r.tick(output, 50.0, 1e6, 0.0);
  EXPECT_NEAR(report.hand_torque_n_mm.norm(), r.run.model.settings.limits.torque_max_n_mm, 1e-9);
}

TEST(HandOutput, WithoutLoadThereIsNothingFromOneTickToTheNext) {
  Rendering r;
  sim::HandOutput output(0.0);
  for (int i = 0; i < 100; ++i) r.tick(output, 50.0, 900.0, 0.0);
  const auto report = r.tick(output, 0.0, 0.0, 0.0);
  EXPECT_EQ(report.hand_force_n.norm(), 0.0);
  EXPECT_EQ(report.hand_torque_n_mm.norm(), 0.0);
}

TEST(Step, AHandleThatTurnsRoundInATickLeavesEverythingFinite) {
  SmallRun run(slab({48, 48, 48}, 0.25, 8.0, 0.6), slab_plan(slab({48, 48, 48}, 0.25, 8.0, 0.6), 8.0),
               "sphere 6,4", steady_push(1.0, 1.0));
  for (int tick = 0; tick < 200; ++tick) {
    device::DeviceInput input;
    Pose plan_from_handle{Mat3::Identity(), Vec3(0, 0, tick < 50 ? -1.0 + 0.03 * tick : 0.5)};
    if (tick >= 100 && tick % 2 == 0) plan_from_handle.rotation << -1, 0, 0, 0, -1, 0, 0, 0, 1;
    input.world_from_handle = run.model.world_from_plan * plan_from_handle;
    input.spindle_on = true;
    record::TickReport report;
    ASSERT_EQ(sim::step(run.model, run.state, input, report), sim::StepStatus::ok) << tick;
  }
}

}  // namespace
}  // namespace ream::test
