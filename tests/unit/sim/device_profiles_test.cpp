#include <gtest/gtest.h>

#include "support/small_run.hpp"

namespace ream::test {
namespace {

constexpr double profile_surface_mm = 9.0, profile_thrust_n = 52.0;

/// A hand that waits out the start-up ramp in the air, then leans on the bone; the force scale is such that
/// the thrust takes most of what the device can do.
device::Script leaning(const device::DeviceTraits& traits) {
  device::Script script;
  script.device_profile = traits.profile;
  script.duration_s = 6.0;
  script.force_scale = profile_thrust_n / (0.8 * traits.force_max_n);
  script.hand.start_mm = Vec3(0.1, -0.1, -1.0);
  script.hand.force_profile = {{0.0, 0.0}, {2.2, 0.0}, {3.2, profile_thrust_n}};
  script.hand.tremor_rms_n = 1.0;
  script.hand.correction_gain = 0.3;
  script.hand.wrist = device::Wrist{};
  return script;
}

class EveryDevice : public testing::TestWithParam<std::string> {};

TEST_P(EveryDevice, LetsAHandReamWithinItsLimits) {
  const device::DeviceTraits traits = device::device_profile(GetParam());
  const device::Script script = leaning(traits);
  sim::Settings settings = SmallRun::settings(script, "cpu");
  sim::fit_to_device(traits, 0.0, settings);
  voxel::BoneModel bone = slab({96, 96, 96}, 0.15, profile_surface_mm, 0.5);
  const case_::Plan plan = slab_plan(bone, profile_surface_mm);
  SmallRun run(std::move(bone), plan, "sphere 8,5", script, settings);
  const auto reports = run.run();
  ASSERT_EQ(reports.size(), 6000u);
  for (const auto& r : reports) {
    ASSERT_LE(r.hand_force_n.norm(), traits.force_max_n * (1.0 + 1e-12)) << "tick " << r.tick;
    ASSERT_LE(r.hand_torque_n_mm.norm(), traits.torque_max_n_mm * (1.0 + 1e-12)) << "tick " << r.tick;
  }
  double thrust_sum_n = 0.0, feed_sum_mm_s = 0.0, felt_sum_n = 0.0;
  for (size_t i = 5000; i < reports.size(); ++i) {
    thrust_sum_n += reports[i].thrust_n;
    feed_sum_mm_s += reports[i].feed_rate_mm_s;
    felt_sum_n += script.force_scale * reports[i].hand_force_n.norm();
  }
  // The tremor and the arm's damping take and give a newton or two.
  EXPECT_NEAR(thrust_sum_n / 1000.0, profile_thrust_n, 2.0);
  EXPECT_NEAR(feed_sum_mm_s / 1000.0, 0.25, 0.015);
  EXPECT_NEAR(felt_sum_n / thrust_sum_n, 1.0, 0.01) << "the hand feels what the tool presses with";
}

INSTANTIATE_TEST_SUITE_P(Profiles, EveryDevice, testing::ValuesIn(device::device_profile_names()),
                         [](const auto& profile) {
                           std::string name = profile.param;
                           std::replace_if(
                               name.begin(), name.end(), [](char c) { return c == '.' || c == '-'; }, '_');
                           return name;
                         });

/// Off the middle of its guide a hand whose wrist yields turns until the wrist's torque is the bone's.
TEST(HandInBone, WristYieldsToOffCentreContact) {
  device::Script script = steady_push(52.0, 2.0);
  script.hand.wrist = device::Wrist{2.0e4, 400.0, 1.0e4};
  voxel::BoneModel bone = slab({96, 96, 96}, 0.15, profile_surface_mm, 1.5);
  // Half of the slab is missing: the reamer's cap touches with one side only.
  for (int w = 0; w < 96; ++w)
    for (int v = 0; v < 96; ++v)
      for (int u = 0; u < 49; ++u) bone.coverage[bone.grid.index(u, v, w)] = 0;
  const case_::Plan plan = slab_plan(bone, profile_surface_mm);
  SmallRun run(std::move(bone), plan, "sphere 8,5", script);
  const auto reports = run.run();
  ASSERT_EQ(reports.size(), 2000u);
  const auto& last = reports.back();
  const Pose plan_from_handle = run.model.world_from_plan.inverse() * last.world_from_handle;
  const Vec3 turned_rad = small_vector_from_rotation(plan_from_handle.rotation);
  const Vec3 torque_n_mm = run.model.world_from_plan.rotation.transpose() * last.hand_torque_n_mm;
  EXPECT_GT(turned_rad.norm(), 1e-5);
  EXPECT_LT((2.0e4 * turned_rad - torque_n_mm).norm(), 0.05 * torque_n_mm.norm());
}

}  // namespace
}  // namespace ream::test
