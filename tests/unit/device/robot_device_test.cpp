#include <gtest/gtest.h>

#include <algorithm>

#include "core/clock.hpp"
#include "device/simulated/scripted_device.hpp"
#include "support/expect_error.hpp"
#include "support/random_pose.hpp"
#include "support/seed.hpp"

namespace ream::device {
namespace {

/// A wall at z = 0 of the plan frame that a mass of 1 kg meets and that yields as a damper. Hand newtons.
struct YieldingWall {
  double damping_n_s_mm;
  Vec3 position_mm;
  Vec3 velocity_mm_s = Vec3::Zero();

  void take(const Vec3& force_n) {
    // Damping implicitly, as in sim: 1 N on 1 kg is 1000 mm/s^2.
    const double damping = position_mm.z() >= 0.0 && force_n.z() >= 0.0 ? damping_n_s_mm : 0.0;
    velocity_mm_s = (velocity_mm_s + tick_s * 1000.0 * force_n) / (1.0 + tick_s * 1000.0 * damping);
    position_mm += tick_s * velocity_mm_s;
  }
};

struct Sample {
  double t_s, force_n, z_mm;
};

std::vector<Sample> run(const Script& script, const Pose& world_from_plan, YieldingWall wall) {
  const auto device = make_scripted_device(script, world_from_plan);
  DeviceInput input;
  device->open();
  std::vector<Sample> samples;
  while (device->read(input) == DeviceStatus::ok) {
    const Vec3 force_n = world_from_plan.rotation.transpose() * input.hand_force_n;
    samples.push_back({static_cast<double>(samples.size()) * tick_s, script.force_scale * force_n.z(),
                       wall.position_mm.z()});
    wall.take(force_n);
    device->write({Vec3::Zero(), Vec3::Zero(), Vec3::Zero(),
                   world_from_plan * Pose{Mat3::Identity(), wall.position_mm}});
  }
  return samples;
}

Script protocol() {
  Script script;
  script.kind = ScriptKind::robot;
  script.device_profile = "ideal-admittance";
  script.duration_s = 60.0;
  script.robot.start_mm = Vec3(0, 0, -3);
  script.robot.depth_mm = 1.0;
  return script;
}

TEST(RobotDevice, ApproachesRampsHoldsAndWithdraws) {
  std::mt19937 random(test::seed(31));
  const Pose world_from_plan = test::random_pose(random);
  // 52 N on 260 N s/mm: 0.2 mm/s.
  const auto samples = run(protocol(), world_from_plan, {260.0, Vec3(0, 0, -3)});
  ASSERT_FALSE(samples.empty());
  size_t touch = 0;
  while (touch < samples.size() && samples[touch].z_mm < 0.0) ++touch;
  // 3 mm at 2 mm/s, started up with a time constant of 10 ms.
  EXPECT_NEAR(samples[touch].t_s, 1.51, 0.02);
  EXPECT_NEAR((samples[1000].z_mm - samples[500].z_mm) / 0.5, 2.0, 0.01);

  // Ramp from nothing to 52 N over 2 s from the moment that it notices.
  const double start_s = samples[touch].t_s + 0.02;
  double deepest_mm = 0.0;
  for (const Sample& s : samples) {
    deepest_mm = std::max(deepest_mm, s.z_mm);
    const double since_s = s.t_s - start_s;
    if (since_s < 0.01 || since_s > 4.9) continue;
    ASSERT_NEAR(s.force_n, 52.0 * std::min(1.0, since_s / 2.0), 0.3) << s.t_s;
  }
  // Half of the ramp's time counts: 0.2 mm in it, then 0.8 mm at 0.2 mm/s.
  EXPECT_NEAR(deepest_mm, 1.0, 0.02);
  EXPECT_NEAR(samples.back().z_mm, -3.0, 0.01);
  EXPECT_NEAR(samples.back().t_s, start_s + 2.0 + 4.0 + 2.0, 0.1);
}

TEST(RobotDevice, PressesWithSimulatedNewtonsAtAnyForceScale) {
  Script script = protocol();
  script.force_scale = 26.0;
  script.duration_s = 5.0;
  const auto samples = run(script, Pose{}, {2000.0 / 26.0, Vec3(0, 0, -3)});
  ASSERT_EQ(samples.size(), 5000u);
  EXPECT_NEAR(samples.back().force_n, 52.0, 1e-6);
}

TEST(RobotDevice, GoesOnAfterAPauseAsIfNothingHadBeen) {
  Script script = protocol();
  script.buttons = {{0.5, true, true}, {1.5, true, false}};
  const auto paused = run(script, Pose{}, {260.0, Vec3(0, 0, -3)});
  const auto whole = run(protocol(), Pose{}, {260.0, Vec3(0, 0, -3)});
  // The wall's mass does not stop for a pause, so the paused robot is a little ahead; it presses for as long.
  const auto held = [](const std::vector<Sample>& samples) {
    return std::count_if(samples.begin(), samples.end(), [](const Sample& s) { return s.force_n > 51.9; });
  };
  EXPECT_NEAR(static_cast<double>(held(paused)), static_cast<double>(held(whole)), 10.0);
}

TEST(RobotDevice, NeedsADeviceThatTakesForce) {
  Script script = protocol();
  script.device_profile = "ideal";
  test::expect_error(ErrorKind::invalid_input, "admittance", [&] { make_scripted_device(script, Pose{}); });
}

TEST(RobotDevice, KeepsItsLineAsFirmlyAsItsArmIsStiff) {
  for (const double stiffness_n_mm : {20.0, 200.0, 1000.0}) {
    Script script = protocol();
    script.duration_s = 2.0;
    script.robot.line_stiffness_n_mm = stiffness_n_mm;
    script.robot.start_mm.z() = -30.0;
    const auto device = make_scripted_device(script, Pose{});
    DeviceInput input;
    device->open();
    YieldingWall mass{260.0, script.robot.start_mm};
    double farthest_mm = 0.0, held_mm = 0.0;
    for (int tick = 0; device->read(input) == DeviceStatus::ok; ++tick) {
      const bool pushed = tick > 100 && tick < 1500;
      mass.take(input.hand_force_n + Vec3(pushed ? 10.0 : 0.0, 0, 0));
      farthest_mm = std::max(farthest_mm, mass.position_mm.x());
      if (pushed) held_mm = mass.position_mm.x();
      device->write({Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Pose{Mat3::Identity(), mass.position_mm}});
    }
    const double deflection_mm = 10.0 / stiffness_n_mm;
    EXPECT_NEAR(held_mm, deflection_mm, 0.02 * deflection_mm) << stiffness_n_mm;
    EXPECT_LT(farthest_mm, 2.0 * deflection_mm) << stiffness_n_mm;
    EXPECT_LT(std::abs(mass.position_mm.x()), 0.02 * deflection_mm) << stiffness_n_mm;
  }
}

TEST(RobotDevice, BeginsAnewWhenOpenedAgain) {
  const auto a = run(protocol(), Pose{}, {260.0, Vec3(0, 0, -3)}),
             b = run(protocol(), Pose{}, {260.0, Vec3(0, 0, -3)});
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) ASSERT_EQ(a[i].force_n, b[i].force_n);
}

}  // namespace
}  // namespace ream::device
