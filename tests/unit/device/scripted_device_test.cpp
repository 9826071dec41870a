#include <gtest/gtest.h>

#include <cmath>

#include "device/simulated/scripted_device.hpp"
#include "support/random_pose.hpp"
#include "support/seed.hpp"

namespace ream::device {
namespace {

constexpr double tick_length_s = 1e-3;

/// Positions in the plan frame, one per tick until the script ends.
std::vector<Vec3> positions(HapticDevice& device, const Pose& world_from_plan) {
  std::vector<Vec3> found;
  DeviceInput input;
  device.open();
  while (device.read(input) == DeviceStatus::ok) {
    found.push_back(world_from_plan.inverse().point(input.world_from_handle.translation_mm));
    device.write({});
  }
  return found;
}

Script pushing(double force_n, double duration_s) {
  Script script;
  script.duration_s = duration_s;
  script.hand.force_profile = {{0.0, force_n}};
  script.hand.mass_kg = 10.0;
  script.hand.arm_damping_n_s_mm = 0.05;
  return script;
}

TEST(HandDevice, FreeHandMovesAsAMassInADamper) {
  std::mt19937 random(test::seed(11));
  const Pose world_from_plan = test::random_pose(random);
  Script script = pushing(4.0, 2.0);
  script.hand.tilt_rad = Vec3(0.2, -0.1, 0.0);
  const auto device = make_scripted_device(script, world_from_plan);
  const std::vector<Vec3> path = positions(*device, world_from_plan);
  ASSERT_EQ(path.size(), 2000u);

  // m v' = F - B v from rest: v = F/B (1 - e^(-t/T)), T = m/B; 1 N = 1000 kg mm/s^2.
  const double final_mm_s = 4.0 / 0.05, time_constant_s = 10.0 / (0.05 * 1000.0);
  const Vec3 line = rotation_from_small_vector(script.hand.tilt_rad).col(2);
  for (size_t i = 0; i < path.size(); ++i) {
    const double t_s = static_cast<double>(i + 1) * tick_length_s;
    const double expected_mm =
        final_mm_s * (t_s - time_constant_s * (1.0 - std::exp(-t_s / time_constant_s)));
    // Euler's method is off by at most half a tick's way.
    ASSERT_LT((path[i] - script.hand.start_mm - expected_mm * line).norm(), 0.5 * tick_length_s * final_mm_s)
        << "tick " << i;
  }
  const double last_mm_s = (path[1999] - path[1998]).norm() / tick_length_s;
  EXPECT_NEAR(last_mm_s, final_mm_s, final_mm_s * std::exp(-2.0 / time_constant_s) * 1.1);
}

TEST(HandDevice, MovesAlikeAtAnyForceScaleAndFeelsScaledForce) {
  const Pose world_from_plan;
  for (const double scale : {1.0, 26.0}) {
    Script script = pushing(4.0, 3.0);
    script.force_scale = scale;
    const auto device = make_scripted_device(script, world_from_plan);
    DeviceInput input;
    device->open();
    double before_mm = 0.0;
    while (device->read(input) == DeviceStatus::ok) {
      // What the hand feels, times the scale, is half of what it pushes: it ends at half the speed.
      device->write({Vec3(0, 0, -2.0 / scale), Vec3::Zero(), Vec3::Zero(), {}});
      const double now_mm = input.world_from_handle.translation_mm.z();
      if (now_mm > script.hand.start_mm.z() + 100.0) {
        EXPECT_NEAR((now_mm - before_mm) / tick_length_s, 2.0 / 0.05, 0.05);
        break;
      }
      before_mm = now_mm;
    }
    EXPECT_GT(before_mm, 50.0);
  }
}

TEST(HandDevice, SpringBringsItBackToItsLine) {
  Script script = pushing(0.0, 2.0);
  const auto device = make_scripted_device(script, Pose{});
  DeviceInput input;
  device->open();
  double farthest_mm = 0.0;
  for (int tick = 0; device->read(input) == DeviceStatus::ok; ++tick) {
    farthest_mm = std::max(farthest_mm, std::abs(input.world_from_handle.translation_mm.x()));
    device->write({Vec3(tick < 500 ? 10.0 : 0.0, 0, 0), Vec3::Zero(), Vec3::Zero(), {}});
  }
  // 10 N against 20 N/mm: half a millimetre where it settles, at most twice that on the way.
  EXPECT_GT(farthest_mm, 0.45);
  EXPECT_LT(farthest_mm, 1.0);
  EXPECT_LT(std::abs(input.world_from_handle.translation_mm.x()), 0.02);
}

TEST(HandDevice, RestsWherePausedAndGoesOnAfterwards) {
  Script script = pushing(20.0, 1.0);
  script.buttons = {{0.3, true, true}, {0.6, true, false}};
  const auto device = make_scripted_device(script, Pose{});
  const std::vector<Vec3> path = positions(*device, Pose{});
  ASSERT_EQ(path.size(), 1000u);
  for (size_t i = 300; i < 600; ++i) ASSERT_EQ(path[i], path[299]) << "tick " << i;
  // From rest again, the same 300 ticks give the same way.
  EXPECT_NEAR((path[899] - path[599]).norm(), (path[299] - script.hand.start_mm).norm(), 1e-9);
}

TEST(HandDevice, BeginsAnewWhenOpenedAgain) {
  const auto device = make_scripted_device(pushing(20.0, 0.2), Pose{});
  EXPECT_EQ(positions(*device, Pose{}), positions(*device, Pose{}));
}

TEST(HandDevice, ShakesByItsSeed) {
  Script script = pushing(0.0, 0.5);
  script.hand.tremor_rms_n = 2.0;
  const auto path_of = [&](uint64_t seed) {
    return positions(*make_scripted_device(script, Pose{}, seed), Pose{});
  };
  EXPECT_EQ(path_of(1), path_of(1));
  EXPECT_NE(path_of(1), path_of(2));
}

TEST(PoseDevice, FollowsItsPosesWhateverItFeels) {
  std::mt19937 random(test::seed(12));
  const Pose world_from_plan = test::random_pose(random);
  Script script;
  script.kind = ScriptKind::poses;
  script.duration_s = 2.0;
  script.poses = {{0.0, Vec3(0, 0, -5), Vec3(0, 0, 0)}, {1.0, Vec3(1, 2, 3), Vec3(0.3, 0, 0)}};
  const auto device = make_scripted_device(script, world_from_plan);
  DeviceInput input;
  device->open();
  int ticks = 0;
  for (; device->read(input) == DeviceStatus::ok; ++ticks) {
    const double s = std::min(1.0, ticks * tick_length_s);
    const Pose plan_from_handle = world_from_plan.inverse() * input.world_from_handle;
    ASSERT_LT((plan_from_handle.translation_mm - (Vec3(0, 0, -5) + s * Vec3(1, 2, 8))).norm(), 1e-9);
    // The Cayley map is exact to third order in the angle.
    ASSERT_LT((plan_from_handle.rotation - test::rotation_about(Vec3::UnitX(), 0.3 * s)).norm(), 0.01);
    device->write({Vec3(0, 0, 1e3), Vec3(1e3, 0, 0), Vec3::Zero(), {}});
  }
  EXPECT_EQ(ticks, 2000);
}

TEST(ScriptedDevice, ButtonsReachTheLoop) {
  Script script;
  script.kind = ScriptKind::poses;
  script.duration_s = 0.01;
  script.poses = {{0.0, Vec3::Zero(), Vec3::Zero()}};
  script.buttons = {{0.004, false, false}, {0.007, false, true}};
  const auto device = make_scripted_device(script, Pose{});
  DeviceInput input;
  device->open();
  for (int tick = 0; tick < 10; ++tick) {
    ASSERT_EQ(device->read(input), DeviceStatus::ok);
    EXPECT_EQ(input.spindle_on, tick < 4) << "tick " << tick;
    EXPECT_EQ(input.paused, tick >= 7) << "tick " << tick;
  }
}

TEST(ScriptedDevice, IsFinishedAtItsDurationAndKeepsTheLastInput) {
  const auto device = make_scripted_device(pushing(20.0, 0.25), Pose{});
  DeviceInput input;
  device->open();
  int ticks = 0;
  while (device->read(input) == DeviceStatus::ok) ++ticks;
  EXPECT_EQ(ticks, 250);
  const Vec3 last = input.world_from_handle.translation_mm;
  EXPECT_EQ(device->read(input), DeviceStatus::finished);
  EXPECT_EQ(input.world_from_handle.translation_mm, last);
}

/// Reads that it takes to the end, when the session is paused during reads 100 to 149.
int reads_with_a_pause(HapticDevice& device, std::vector<Vec3>* places_mm = nullptr) {
  DeviceInput input;
  device.open();
  int reads = 0;
  for (;; ++reads) {
    device.session_paused(reads >= 100 && reads < 150);
    if (device.read(input) != DeviceStatus::ok) return reads;
    EXPECT_EQ(input.paused, reads >= 100 && reads < 150) << reads;
    if (places_mm != nullptr) places_mm->push_back(input.world_from_handle.translation_mm);
    device.write({});
  }
}

TEST(ScriptedDevice, AScriptWaitsWhileTheSessionIsPaused) {
  Script poses;
  poses.kind = ScriptKind::poses;
  poses.duration_s = 0.3;
  poses.poses = {{0.0, Vec3::Zero(), Vec3::Zero()}, {0.3, Vec3(30.0, 0.0, 0.0), Vec3::Zero()}};
  std::vector<Vec3> way_mm;
  const auto device = make_scripted_device(poses, Pose{});
  EXPECT_EQ(reads_with_a_pause(*device, &way_mm), 350);
  for (size_t i = 100; i < 150; ++i) EXPECT_EQ(way_mm[i], way_mm[100]);
  EXPECT_NEAR((way_mm[150] - way_mm[99]).norm(), 0.1, 1e-9);

  Script hand = pushing(4.0, 0.3);
  EXPECT_EQ(reads_with_a_pause(*make_scripted_device(hand, Pose{})), 350);
  hand.device_profile = "ideal-admittance";
  EXPECT_EQ(reads_with_a_pause(*make_scripted_device(hand, Pose{})), 350);
}

}  // namespace
}  // namespace ream::device
