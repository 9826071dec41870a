#include "device/registry/device_registry.hpp"

#include "core/error.hpp"
#include "device/device_setup.hpp"
#include "device/profiles.hpp"
#include "device/vendors/force_dimension_servo.hpp"
#include "device/vendors/haply_servo.hpp"
#include "device/vendors/open_haptics_servo.hpp"
#include "device/vendors/servo_device.hpp"

namespace ream::device {
namespace {

namespace fs = std::filesystem;

/// A driver: how one is made, and why none can be had now (empty: it can).
struct Driver {
  std::string name, about;
  std::vector<std::string> profiles;  ///< of the models that it drives; the first is the usual one
  std::unique_ptr<Servo> (*make)(const DeviceSetup& setup, const DeviceTraits& traits);
  std::string (*why_not)(const DeviceSetup& setup);
};

DeviceInfo offer(const Driver& driver, const fs::path& data) {
  DeviceInfo offer = offer_of(driver.name, driver.about, driver.profiles.front());
  try {
    offer.reason = driver.why_not(load_device_setup(data, driver.name));
  } catch (const Error& e) {
    offer.reason = e.what();
  }
  offer.usable = offer.reason.empty();
  return offer;
}

MadeDevice make(const Driver& driver, const DeviceRequest& request) {
  const std::string profile = profile_of(request, driver.profiles.front());
  require_fitting_profile(driver.name, driver.profiles, profile);
  DeviceTraits traits = device_profile(profile);
  traits.name = driver.name;
  auto servo = driver.make(load_device_setup(request.data, driver.name), traits);
  return {mapped(request, std::make_unique<ServoDevice>(std::move(traits), std::move(servo))), nullptr};
}

DeviceKind kind_of(const Driver& driver) {
  return {driver.name, driver.profiles.front(),
          [driver](const fs::path& data) { return offer(driver, data); },
          [driver](const DeviceRequest& request) { return make(driver, request); }, driver.profiles};
}

}  // namespace

std::vector<DeviceKind> real_device_kinds() {
  return {kind_of({"haply",
                   "Haply Inverse3, with or without a grip, through Haply's Inverse Service",
                   {"inverse3"},
                   make_haply_servo,
                   haply_fault}),
          kind_of({"forcedimension",
                   "Force Dimension's omega, delta, sigma and lambda, and Novint Falcon",
                   {"omega.3", "omega.6", "omega.7", "delta.3", "sigma.7", "lambda.7", "falcon"},
                   make_force_dimension_servo,
                   force_dimension_fault}),
          kind_of({"openhaptics",
                   "3D Systems' Touch and Phantom, through OpenHaptics",
                   {"touch", "phantom-omni", "phantom-desktop", "premium-1.5-6dof", "premium-3.0-6dof"},
                   make_open_haptics_servo,
                   open_haptics_fault})};
}

}  // namespace ream::device
