#include "device/profiles.hpp"

#include <gtest/gtest.h>

#include <set>

#include "support/expect_error.hpp"

namespace ream::device {
namespace {

TEST(DeviceProfiles, AreAllUsable) {
  std::set<std::string> seen;
  for (const std::string& name : device_profile_names()) {
    SCOPED_TRACE(name);
    EXPECT_TRUE(seen.insert(name).second);
    const DeviceTraits t = device_profile(name);
    EXPECT_EQ(t.profile, name);
    EXPECT_GT(t.force_max_n, 0.0);
    EXPECT_GE(t.torque_max_n_mm, 0.0);
    EXPECT_GT(t.stiffness_max_n_mm, 0.0);
    EXPECT_LE(t.stiffness_max_n_mm, 100.0) << "the most that a script may ask for";
    EXPECT_GT(t.angular_stiffness_max_n_mm_rad, 0.0);
    EXPECT_GT(t.workspace_radius_mm, 0.0);
    EXPECT_GE(t.degrees_of_freedom, 3);
    EXPECT_EQ(t.effective_mass_kg > 0.0, t.causality == Causality::admittance);
    const bool ideal = name.starts_with("ideal");
    EXPECT_EQ(t.start_up_ramp_s, ideal ? 0.0 : 2.0);
    EXPECT_EQ(t.handle_mass_kg > 0.0, t.causality == Causality::impedance);
    EXPECT_EQ(t.vibration_max_n, 0.25 * t.force_max_n) << "contact is felt while it shakes";
  }
  EXPECT_EQ(seen.size(), 19u);
}

TEST(DeviceProfiles, AreInMillimetres) {
  const DeviceTraits sigma = device_profile("sigma.7");
  EXPECT_DOUBLE_EQ(sigma.force_max_n, 12.0);
  EXPECT_DOUBLE_EQ(sigma.torque_max_n_mm, 200.0);
  EXPECT_DOUBLE_EQ(sigma.stiffness_max_n_mm, 4.0);
  EXPECT_DOUBLE_EQ(sigma.angular_stiffness_max_n_mm_rad, 4000.0);
  EXPECT_DOUBLE_EQ(sigma.damping_max_n_s_mm, 0.03);
  EXPECT_DOUBLE_EQ(sigma.workspace_radius_mm, 75.0);
  const DeviceTraits kuka = device_profile("kuka-iiwa-7");
  EXPECT_DOUBLE_EQ(kuka.angular_stiffness_max_n_mm_rad, 300000.0);
  EXPECT_NEAR(kuka.force_max_n, 68.6, 0.1);
}

TEST(DeviceProfiles, IdealIsWhatScriptsAlwaysHad) {
  const DeviceTraits t = device_profile("ideal");
  EXPECT_EQ(t.causality, Causality::impedance);
  EXPECT_EQ(t.force_max_n, 1000.0);
  EXPECT_EQ(t.torque_max_n_mm, 100000.0);
  EXPECT_EQ(t.stiffness_max_n_mm, 100.0);
  EXPECT_GE(t.angular_stiffness_max_n_mm_rad, 1000.0 * t.stiffness_max_n_mm);
  EXPECT_EQ(device_profile("ideal-admittance").causality, Causality::admittance);
}

TEST(DeviceProfiles, UnknownOnesAreRefusedWithTheList) {
  test::expect_error(ErrorKind::invalid_input, "no device profile 'omega'", [] { device_profile("omega"); });
  test::expect_error(ErrorKind::invalid_input, "omega.3, omega.6", [] { device_profile(""); });
}

}  // namespace
}  // namespace ream::device
