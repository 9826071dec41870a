#include "app/real_devices.hpp"

#include "core/error.hpp"
#include "device/device_setup.hpp"
#include "device/force_dimension_servo.hpp"
#include "device/haply_servo.hpp"
#include "device/open_haptics_servo.hpp"
#include "device/profiles.hpp"
#include "device/servo_device.hpp"

namespace ream::app {
namespace {

namespace fs = std::filesystem;

/// A driver: how one is made, and why none can be had now (empty: it can).
struct Driver {
  std::string name, about;
  std::vector<std::string> profiles;  ///< of the models that it drives; the first is the usual one
  std::unique_ptr<device::Servo> (*make)(const device::DeviceSetup& setup,
                                         const device::DeviceTraits& traits);
  std::string (*why_not)(const device::DeviceSetup& setup);
};

DeviceOffer offer(const Driver& driver, const fs::path& data) {
  DeviceOffer offer = offer_of(driver.name, driver.about, driver.profiles.front());
  try {
    offer.reason = driver.why_not(device::load_device_setup(data, driver.name));
  } catch (const Error& e) {
    offer.reason = e.what();
  }
  offer.usable = offer.reason.empty();
  return offer;
}

MadeDevice make(const Driver& driver, const DeviceWish& wish) {
  const std::string profile = profile_of(wish, driver.profiles.front());
  require_fitting_profile(driver.name, driver.profiles, profile);
  device::DeviceTraits traits = device::device_profile(profile);
  traits.name = driver.name;
  auto servo = driver.make(device::load_device_setup(wish.data, driver.name), traits);
  return {mapped(wish, std::make_unique<device::ServoDevice>(std::move(traits), std::move(servo))), nullptr};
}

DeviceKind kind_of(const Driver& driver) {
  return {driver.name, driver.profiles.front(),
          [driver](const fs::path& data) { return offer(driver, data); },
          [driver](const DeviceWish& wish) { return make(driver, wish); }, driver.profiles};
}

}  // namespace

std::vector<DeviceKind> real_device_kinds() {
  return {kind_of({"haply",
                   "Haply Inverse3, with or without a grip, through Haply's Inverse Service",
                   {"inverse3"},
                   device::make_haply_servo,
                   device::why_no_haply}),
          kind_of({"forcedimension",
                   "Force Dimension's omega, delta, sigma and lambda, and Novint Falcon",
                   {"omega.3", "omega.6", "omega.7", "delta.3", "sigma.7", "lambda.7", "falcon"},
                   device::make_force_dimension_servo,
                   device::why_no_force_dimension}),
          kind_of({"openhaptics",
                   "3D Systems' Touch and Phantom, through OpenHaptics",
                   {"touch", "phantom-omni", "phantom-desktop", "premium-1.5-6dof", "premium-3.0-6dof"},
                   device::make_open_haptics_servo,
                   device::why_no_open_haptics})};
}

}  // namespace ream::app
