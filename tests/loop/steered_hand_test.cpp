// The hand of somebody with a mouse, reaming a slab in simulated time.
#include "device/simulated/steered_hand_device.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "device/profiles.hpp"
#include "sim/settings.hpp"
#include "support/small_run.hpp"

namespace ream::test {
namespace {

int64_t now_ns = 0;
int64_t test_clock() { return now_ns; }

constexpr double density_g_cc = 0.5;

/// A person whose wishes arrive every 16 ms, on a rigid slab.
class SteeredHand : public testing::Test {
 protected:
  SteeredHand() {
    now_ns = 1'000'000'000;
    hand->open();
  }

  static device::Script script() {
    device::Script practice = device::practice_script();
    device::fit_to_remote("ideal", practice);
    return practice;
  }

  /// One tick; the wish is heard each 16 ms while `hears`.
  record::TickReport tick(bool hears = true) {
    now_ns += tick_ns;
    if (hears && ticks++ % 16 == 0) {
      command.arrived_ns = now_ns;
      command.connection = 1;
      command.steering = true;
      command.spindle_on = true;
      link->input.store(command);
    }
    EXPECT_EQ(hand->read(input), device::DeviceStatus::ok);
    record::TickReport report;
    EXPECT_EQ(sim::step(model, state, input, report), sim::StepStatus::ok);
    hand->write(sim::output_of(report));
    return report;
  }
  record::TickReport run(double seconds) {
    record::TickReport report;
    for (int i = 0; i < seconds * 1000.0; ++i) report = tick();
    return report;
  }
  double depth_mm(const record::TickReport& report) const {
    return (model.world_from_plan.inverse() * report.world_from_tool).translation_mm.z();
  }

  voxel::BoneModel bone = slab({80, 80, 80}, 0.2, 10.0, density_g_cc);
  sim::Model model = sim::make_model(slab_plan(bone, 10.0), bone, shell::make_tool("sphere 5"),
                                     SmallRun::settings(script(), "cpu"));
  sim::State state{model, bone};
  std::shared_ptr<device::RemoteLink> link = std::make_shared<device::RemoteLink>();
  std::unique_ptr<device::HapticDevice> hand =
      device::make_steered_hand_device("ideal", model.world_from_plan, 1.0, link, test_clock);
  device::RemoteInput command;
  device::DeviceInput input;
  int ticks = 0;
};

TEST_F(SteeredHand, BeginsBeforeTheEntryAndWaits) {
  const record::TickReport report = tick(false);
  EXPECT_NEAR(depth_mm(report), -10.0, 1e-9);
  EXPECT_TRUE(std::isinf(input.age_ms));
}

TEST_F(SteeredHand, PushingReamsAtTheLawsRateAndReleasingStopsIt) {
  command.push_n = 52.0;
  record::TickReport report;
  for (int i = 0; i < 3000 && !report.engaged; ++i) report = tick();
  ASSERT_TRUE(report.engaged);
  run(3.0);  // the cap seats
  const record::TickReport from = run(0.1), to = run(1.0);
  const double rate_mm_s = depth_mm(to) - depth_mm(from);
  // Eq. 5.1, cancellous, at 52 N; the arm's damping takes less than 1 % of the push.
  EXPECT_NEAR(rate_mm_s, 0.42 - 0.34 * density_g_cc, 0.03 * (0.42 - 0.34 * density_g_cc));
  EXPECT_NEAR(to.thrust_n, 52.0, 1.5);

  command.push_n = 0.0;
  const record::TickReport released = run(0.3);
  const record::TickReport later = run(1.0);
  EXPECT_LT(later.thrust_n, 1.0);
  EXPECT_NEAR(depth_mm(later), depth_mm(released), 0.005);

  command.push_n = -20.0;
  const record::TickReport out = run(1.5);
  EXPECT_FALSE(out.engaged);
  EXPECT_LT(depth_mm(out), -5.0);
  EXPECT_EQ(out.hand_force_n.norm(), 0.0);
}

TEST_F(SteeredHand, PushesAsHardAsItIsToldUpToItsBound) {
  for (const auto& [told_n, pushed_n] : {std::pair(110.0, 110.0), std::pair(500.0, 120.0)}) {
    command.push_n = told_n;
    record::TickReport report;
    for (int i = 0; i < 3000 && !report.engaged; ++i) report = tick();
    ASSERT_TRUE(report.engaged);
    EXPECT_NEAR(run(2.0).thrust_n, pushed_n, 0.03 * pushed_n);
  }
}

TEST_F(SteeredHand, SixtyWishesASecondMakeASmoothMotion) {
  Vec3 before = Vec3::Zero(), speed_before = Vec3::Zero();
  double turn_most = 0.0;
  Mat3 r_before = Mat3::Identity();
  for (int i = 0; i < 2000; ++i) {
    // Wishes that jump from one side to the other.
    const bool there = (i / 250) % 2 == 0;
    command.sideways_mm = {there ? 50.0 : -50.0, there ? -20.0 : 30.0, 500.0};
    command.lean = {there ? 0.3 : -0.3, 0.2, -1.0};
    command.push_n = there ? -25.0 : 10.0;
    tick();
    const Vec3 place = input.world_from_handle.translation_mm;
    const Vec3 speed = (place - before) / tick_s;
    if (i > 1) {
      EXPECT_LT(speed.norm(), 120.0) << i;
      EXPECT_LT((speed - speed_before).norm(), 12.0) << i;
      turn_most = std::max(turn_most, turn_between(r_before, input.world_from_handle.rotation).norm());
    }
    before = place;
    speed_before = speed;
    r_before = input.world_from_handle.rotation;
  }
  EXPECT_LE(turn_most, 0.0011);
}

TEST_F(SteeredHand, WishesAreBounded) {
  command.sideways_mm = {1000.0, -500.0, 0.0};
  command.lean = {1.0, 1.0, 0.2};
  command.push_n = -900.0;
  run(30.0);
  const Pose plan_from_handle = model.world_from_plan.inverse() * input.world_from_handle;
  const Vec3 place = plan_from_handle.translation_mm;
  const Vec3 axis = plan_from_handle.rotation.col(2);
  EXPECT_NEAR(std::acos(axis.z()), device::SteeringLimits::max_lean_rad, 1e-3);
  // The line stands aslant: at its plan height it is within the bound.
  const Vec3 on_line = place - axis * (place.z() / axis.z());
  EXPECT_NEAR(on_line.norm(), device::SteeringLimits::max_sideways_mm, 0.5);
  EXPECT_GT(place.z(), -70.0);
}

TEST_F(SteeredHand, WhenWishesStopThePushFallsToNothing) {
  command.push_n = 60.0;
  record::TickReport report;
  for (int i = 0; i < 3000 && !report.engaged; ++i) report = tick();
  run(0.5);
  const Vec3 held = input.world_from_handle.translation_mm;
  while (input.age_ms < device::browser_stale_limits.fade_ms + 20.0) report = tick(false);
  const record::TickReport faded = report;
  for (int i = 0; i < 200; ++i) report = tick(false);
  EXPECT_LT(report.thrust_n, 5.0);
  EXPECT_NEAR(depth_mm(report), depth_mm(faded), 0.02);
  EXPECT_LT((input.world_from_handle.translation_mm - held).norm(), 1.0);
  while (input.age_ms < device::browser_stale_limits.lost_ms + 1.0) tick(false);
  const Vec3 resting = input.world_from_handle.translation_mm;
  for (int i = 0; i < 1000; ++i) tick(false);
  EXPECT_EQ(input.world_from_handle.translation_mm, resting);
}

}  // namespace
}  // namespace ream::test
