#include "sim/settings.hpp"

#include <gtest/gtest.h>

#include "device/profiles.hpp"

namespace ream::sim {
namespace {

Settings fitted(const std::string& profile, double stiffness_n_mm = 0.0) {
  Settings settings;
  fit_to_device(device::device_profile(profile), stiffness_n_mm, settings);
  return settings;
}

TEST(DeviceSettings, TakeTheDevicesOwnStiffnessWhenNoneIsAskedFor) {
  EXPECT_DOUBLE_EQ(fitted("touch").stiffness_n_mm, 0.4);
  EXPECT_DOUBLE_EQ(fitted("touch", 0.2).stiffness_n_mm, 0.2);
  EXPECT_EQ(fitted("ideal").stiffness_n_mm, 100.0);
  EXPECT_EQ(fitted("ideal").angular_stiffness_n_mm_rad, 1.0e5);
}

TEST(DeviceSettings, KeepWithinTheDevice) {
  const Settings sigma = fitted("sigma.7");
  EXPECT_EQ(sigma.limits.force_max_n, 12.0);
  EXPECT_DOUBLE_EQ(sigma.limits.torque_max_n_mm, 200.0);
  EXPECT_GE(sigma.limits.force_slew_n, sigma.stiffness_n_mm * 0.5) << "half a metre a second goes through";
  EXPECT_LT(sigma.limits.force_slew_n, sigma.limits.force_max_n);
  EXPECT_EQ(sigma.start_up_ramp_s, 2.0);
  EXPECT_EQ(sigma.vibration.vibration_max_n, 3.0);
  EXPECT_FALSE(sigma.virtual_mass.has_value());
  // A softer wrist than a lever would make it is the device's own affair.
  const device::DeviceTraits soft = [] {
    device::DeviceTraits traits = device::device_profile("kuka-iiwa-7");
    traits.angular_stiffness_max_n_mm_rad = 100.0;
    return traits;
  }();
  Settings settings;
  fit_to_device(soft, 0.0, settings);
  EXPECT_EQ(settings.angular_stiffness_n_mm_rad, 100.0);
}

/// The force that moves a handle of 45 g, 250 g or 1.2 kg as the drill moves in cortical bone, 0.30 g rms.
TEST(DeviceSettings, ShakeTheHandleAsTheDrillShakes) {
  EXPECT_NEAR(0.30 * fitted("touch").vibration.vibration_n_per_g, 0.13, 0.005);
  EXPECT_NEAR(0.30 * fitted("omega.6").vibration.vibration_n_per_g, 0.74, 0.005);
  EXPECT_NEAR(0.30 * fitted("kuka-iiwa-7").vibration.vibration_n_per_g, 3.5, 0.05);
}

TEST(DeviceSettings, GiveAdmittanceDevicesTheirMass) {
  const Settings settings = fitted("hapticmaster");
  ASSERT_TRUE(settings.virtual_mass.has_value());
  EXPECT_EQ(settings.virtual_mass->mass_kg, 2.0);
  Settings again = settings;
  fit_to_device(device::device_profile("ideal"), 0.0, again);
  EXPECT_FALSE(again.virtual_mass.has_value());
}

}  // namespace
}  // namespace ream::sim
