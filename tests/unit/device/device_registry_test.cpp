#include "device/registry/device_registry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "device/profiles.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace ream::device {
namespace {

using test::expect_error;

class DeviceRegistry : public testing::Test {
 protected:
  MadeDevice made(const std::string& name, const std::string& profile) {
    script = device::practice_script();
    settle_for_device(name, profile, script);
    return make_device({name, profile, &script, Pose{}, 1, folder.path()});
  }
  const test::TemporaryFolder folder;
  device::Script script;
};

TEST_F(DeviceRegistry, RemoteDevicesHaveALinkAndTheirUsualProfile) {
  const MadeDevice network = made("network", ""), browser = made("browser", "");
  ASSERT_NE(network.link, nullptr);
  ASSERT_NE(browser.link, nullptr);
  EXPECT_EQ(network.device->traits().profile, "touch");
  EXPECT_EQ(browser.device->traits().profile, "ideal");
  EXPECT_EQ(browser.device->traits().stale.fade_ms, device::browser_stale_limits.fade_ms);
  EXPECT_EQ(made("network", "omega.3").device->traits().profile, "omega.3");
}

TEST_F(DeviceRegistry, PracticeIsScaledToWhatTheDeviceRenders) {
  for (const std::string& profile : device::device_profile_names()) {
    const device::DeviceTraits traits = device::device_profile(profile);
    if (traits.causality != device::Causality::impedance) continue;
    made("network", profile);
    EXPECT_LE(80.0 / script.force_scale, traits.force_max_n) << profile;
    EXPECT_TRUE(script.force_scale == 1.0 || 80.0 / (script.force_scale - 1.0) > traits.force_max_n)
        << profile;
  }
}

TEST_F(DeviceRegistry, ADeviceIsNoStifferThanItCanBeWhateverItsScriptSays) {
  device::Script demo = device::demo_script();
  settle_for_device("network", "", demo);
  EXPECT_EQ(demo.device_profile, "touch");
  EXPECT_EQ(demo.stiffness_n_mm, 0.0);
  EXPECT_EQ(demo.force_scale, 1.0);
}

TEST_F(DeviceRegistry, ScriptsPlayWhatTheySay) {
  device::Script demo = device::demo_script();
  settle_for_device("script", "", demo);
  EXPECT_EQ(make_device({"script", "", &demo, Pose{}, 1, folder.path()}).link, nullptr);
  expect_error(ErrorKind::invalid_input, "a script says its own",
               [&] { settle_for_device("script", "touch", demo); });
  expect_error(ErrorKind::invalid_input, "name one", [&] { made("script", ""); });
}

TEST_F(DeviceRegistry, NamesWhatThereIsToThoseWhoAskForSomethingElse) {
  expect_error(ErrorKind::invalid_input, "there are script, network, browser", [&] { made("spoon", ""); });
  expect_error(ErrorKind::invalid_input, "there are omega.3", [&] { made("network", "spoon"); });
  expect_error(ErrorKind::invalid_input, "impedance", [&] { made("network", "hapticmaster"); });
  expect_error(ErrorKind::invalid_input, "impedance", [&] { made("browser", "ideal-admittance"); });
}

/// A profile's force is the limit of real hardware.
TEST_F(DeviceRegistry, RealDevicesTakeTheProfilesOfTheirModelsOnly) {
  const std::map<std::string, std::vector<std::string>> fitting{
      {"haply", {"inverse3"}},
      {"forcedimension", {"omega.3", "omega.6", "omega.7", "delta.3", "sigma.7", "lambda.7", "falcon"}},
      {"openhaptics", {"touch", "phantom-omni", "phantom-desktop", "premium-1.5-6dof", "premium-3.0-6dof"}}};
  for (const auto& [device_name, models] : fitting) {
    const std::string& name = device_name;
    std::string names;
    for (const std::string& model : models) names += (names.empty() ? "" : ", ") + model;
    for (const std::string& profile : device::device_profile_names()) {
      SCOPED_TRACE(name + ", " + profile);
      if (std::find(models.begin(), models.end(), profile) != models.end()) {
        EXPECT_EQ(made(name, profile).device->traits().profile, profile);
        continue;
      }
      const std::string words = "device_profile '" + profile + "' is not of the device '" + name +
                                "'; those that fit it are " + names;
      expect_error(ErrorKind::invalid_input, words, [&] { made(name, profile); });
      expect_error(ErrorKind::invalid_input, words, [&] {
        make_device({name, profile, &script, Pose{}, 1, folder.path()});
      });
      script = device::practice_script();
      script.device_profile = profile;
      expect_error(ErrorKind::invalid_input, words, [&] { settle_for_device(name, "", script); });
    }
    EXPECT_EQ(made(name, "").device->traits().profile, models.front());
  }
}

TEST_F(DeviceRegistry, OffersAreMadeWithoutOpeningAnything) {
  for (const DeviceKind& kind : device_kinds()) {
    const DeviceInfo offer = kind.offer(folder.path());
    EXPECT_EQ(offer.name, kind.name);
    EXPECT_EQ(offer.usable, offer.reason.empty()) << offer.reason;
    if (kind.name == "script" || kind.name == "network" || kind.name == "browser") {
      EXPECT_TRUE(offer.usable);
    }
    EXPECT_NE(offer.about, "");
    EXPECT_GT(offer.force_max_n, 0.0);
  }
}

}  // namespace
}  // namespace ream::device
