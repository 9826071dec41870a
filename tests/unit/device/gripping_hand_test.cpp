#include <gtest/gtest.h>

#include "core/clock.hpp"
#include "device/simulated/scripted_device.hpp"
#include "support/random_pose.hpp"
#include "support/seed.hpp"

namespace ream::device {
namespace {

Script gripping(double force_n, double duration_s, double force_scale = 1.0) {
  Script script;
  script.device_profile = "ideal-admittance";
  script.duration_s = duration_s;
  script.force_scale = force_scale;
  script.hand.force_profile = {{0.0, force_n}};
  return script;
}

TEST(GrippingHand, PressesOnAHandleThatStaysWithWhatItMeans) {
  std::mt19937 random(test::seed(21));
  const Pose world_from_plan = test::random_pose(random);
  for (const double scale : {1.0, 26.0}) {
    const auto device = make_scripted_device(gripping(40.0, 2.0, scale), world_from_plan);
    ASSERT_EQ(device->traits().causality, Causality::admittance);
    DeviceInput input;
    device->open();
    while (device->read(input) == DeviceStatus::ok) device->write({});
    const Vec3 force_n = world_from_plan.rotation.transpose() * input.hand_force_n;
    EXPECT_LT((scale * force_n - Vec3(0, 0, 40)).norm(), 0.01) << "force scale " << scale;
    EXPECT_LT(input.hand_torque_n_mm.norm(), 1e-6);
    const Vec3 start = world_from_plan.inverse().point(input.world_from_handle.translation_mm);
    EXPECT_LT((start - Vec3(0, 0, -10)).norm(), 1e-9) << "the handle is where it began";
  }
}

TEST(GrippingHand, FollowsAHandleThatMovesAndLosesItsArmsDamping) {
  Script script = gripping(40.0, 5.0);
  script.hand.arm_damping_n_s_mm = 2.0;
  const auto device = make_scripted_device(script, Pose{});
  DeviceInput input;
  device->open();
  Pose handle;
  handle.translation_mm = script.hand.start_mm;
  while (device->read(input) == DeviceStatus::ok) {
    handle.translation_mm.z() += 5.0 * tick_s;
    device->write({Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), handle});
  }
  EXPECT_NEAR(input.hand_force_n.z(), 40.0 - 2.0 * 5.0, 0.01);
}

TEST(GrippingHand, WristTurnsAHandleBack) {
  Script script = gripping(0.0, 0.5);
  script.hand.wrist = Wrist{5000.0, 200.0, 10000.0};
  const auto device = make_scripted_device(script, Pose{});
  DeviceInput input;
  device->open();
  Pose handle{rotation_from_small_vector(Vec3(0.02, 0, 0)), script.hand.start_mm};
  while (device->read(input) == DeviceStatus::ok)
    device->write({Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), handle});
  EXPECT_LT((input.hand_torque_n_mm - Vec3(-100, 0, 0)).norm(), 0.1);
}

TEST(GrippingHand, DrivesAFreeMassToTheSpeedOfItsArm) {
  // A mass of 1 kg, as the device's, integrated here: it ends at push / arm damping, without ringing.
  Script script = gripping(20.0, 2.0);
  const auto device = make_scripted_device(script, Pose{});
  DeviceInput input;
  device->open();
  Pose handle;
  handle.translation_mm = script.hand.start_mm;
  Vec3 velocity_mm_s = Vec3::Zero();
  double fastest_mm_s = 0.0;
  while (device->read(input) == DeviceStatus::ok) {
    velocity_mm_s += tick_s * 1000.0 * input.hand_force_n;
    handle.translation_mm += tick_s * velocity_mm_s;
    fastest_mm_s = std::max(fastest_mm_s, velocity_mm_s.norm());
    device->write({Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), handle});
  }
  EXPECT_NEAR(velocity_mm_s.z(), 20.0, 0.1);
  EXPECT_LT(fastest_mm_s, 40.0);
}

}  // namespace
}  // namespace ream::device
