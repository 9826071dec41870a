#include "device/registry/device_registry.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "device/admittance/admittance_device.hpp"
#include "device/mapped_device.hpp"
#include "device/network/network_device.hpp"
#include "device/profiles.hpp"
#include "device/simulated/admittance_plant.hpp"
#include "device/simulated/scripted_device.hpp"
#include "device/simulated/steered_hand_device.hpp"

namespace ream::device {
namespace {

/// A real device's tool begins this far before the planned entry.
constexpr double start_before_entry_mm = 30.0;

}  // namespace

DeviceInfo offer_of(const std::string& name, const std::string& about, const std::string& profile) {
  const DeviceTraits traits = device_profile(profile);
  return {name, about, true, "", traits.force_max_n, traits.degrees_of_freedom};
}

std::string profile_of(const DeviceRequest& request, const std::string& fallback) {
  if (!request.profile.empty()) return request.profile;
  const bool said = request.script->kind == ScriptKind::remote && !request.script->device_profile.empty();
  return said ? request.script->device_profile : fallback;
}

void require_fitting_profile(const std::string& device, const std::vector<std::string>& fitting,
                             const std::string& profile) {
  if (std::find(fitting.begin(), fitting.end(), profile) != fitting.end()) return;
  std::string names;
  for (const std::string& name : fitting) names += (names.empty() ? "" : ", ") + name;
  throw Error(ErrorKind::invalid_input, "device_profile '" + profile + "' is not of the device '" + device +
                                            "'; those that fit it are " + names);
}

std::unique_ptr<HapticDevice> mapped(const DeviceRequest& request, std::unique_ptr<HapticDevice> device) {
  const Pose before_entry{Mat3::Identity(), Vec3(0.0, 0.0, -start_before_entry_mm)};
  return std::make_unique<MappedDevice>(std::move(device), load_device_setup(request.data, request.name),
                                        request.world_from_plan * before_entry);
}

namespace {

DeviceKind scripted() {
  return {"script", "",
          [](const std::filesystem::path&) {
            return offer_of("script", "A simulated hand, robot or list of poses that plays a script",
                            "ideal");
          },
          [](const DeviceRequest& request) {
            return MadeDevice{
                make_scripted_device(*request.script, request.world_from_plan, request.random_seed), nullptr};
          }};
}

DeviceKind network() {
  static const std::string profile = "touch";
  return {"network", profile,
          [](const std::filesystem::path&) {
            return offer_of("network", "A haptic device whose own computer connects over the network",
                            profile);
          },
          [](const DeviceRequest& request) {
            auto link = std::make_shared<RemoteLink>();
            return MadeDevice{
                mapped(request, std::make_unique<NetworkDevice>(profile_of(request, profile), link)), link};
          }};
}

DeviceKind browser() {
  static const std::string profile = "ideal";
  return {"browser", profile,
          [](const std::filesystem::path&) {
            return offer_of("browser", "Mouse, touch screen, keys or gamepad, in the page of the session",
                            profile);
          },
          [](const DeviceRequest& request) {
            auto link = std::make_shared<RemoteLink>();
            return MadeDevice{make_steered_hand_device(profile_of(request, profile), request.world_from_plan,
                                                       request.script->force_scale, link),
                              link};
          }};
}

/// A simulated machine that senses force and moves, in the hand of the script.
DeviceKind plant(const PlantParameters& parameters, const std::string& profile, const std::string& about) {
  return {parameters.name, profile,
          [&parameters, profile, about](const std::filesystem::path&) {
            return offer_of(parameters.name, about, profile);
          },
          [&parameters, profile](const DeviceRequest& request) {
            const Pose plan_from_start{rotation_from_small_vector(request.script->hand.tilt_rad),
                                       request.script->hand.start_mm};
            auto machine = make_admittance_plant(parameters, device_profile(profile_of(request, profile)),
                                                 *request.script, request.random_seed);
            return MadeDevice{std::make_unique<AdmittanceDevice>(std::move(machine),
                                                                 request.world_from_plan * plan_from_start),
                              nullptr};
          }};
}

std::vector<DeviceKind>& known_kinds() {
  static std::vector<DeviceKind> kinds = [] {
    std::vector<DeviceKind> all{
        scripted(), network(), browser(),
        plant(hapticmaster_plant(), "hapticmaster",
              "A simulated HapticMaster: senses the script's hand and moves, with its limits and servo"),
        plant(robot_plant(), "robot-force-mode",
              "A simulated robot arm with a force sensor, moved by the script's hand")};
    for (DeviceKind& real : real_device_kinds()) all.push_back(std::move(real));
    return all;
  }();
  return kinds;
}

}  // namespace

const std::vector<DeviceKind>& device_kinds() { return known_kinds(); }

void add_device_kind(DeviceKind kind) {
  for (const DeviceKind& known : known_kinds())
    if (known.name == kind.name)
      throw Error(ErrorKind::conflict,
                  "there is a device '" + kind.name + "' already; give the plug-in's another name");
  known_kinds().push_back(std::move(kind));
}

const DeviceKind& device_kind(const std::string& name) {
  const std::vector<DeviceKind>& kinds = device_kinds();
  const auto kind =
      std::find_if(kinds.begin(), kinds.end(), [&](const DeviceKind& k) { return k.name == name; });
  if (kind != kinds.end()) return *kind;
  std::string names;
  for (const DeviceKind& known : kinds) names += (names.empty() ? "" : ", ") + known.name;
  throw Error(ErrorKind::invalid_input,
              "no device '" + name + "'; there are " + names + " (`ream devices` tells more)");
}

void settle_for_device(const std::string& device, const std::string& profile, Script& script) {
  const DeviceKind& kind = device_kind(device);
  if (kind.default_profile.empty()) {
    if (!profile.empty())
      throw Error(ErrorKind::invalid_input,
                  "device_profile '" + profile + "' is asked for, but a script says its own");
    return;
  }
  const std::string resolved = profile_of({device, profile, &script, {}, 1, {}}, kind.default_profile);
  if (!kind.profiles.empty()) require_fitting_profile(device, kind.profiles, resolved);
  fit_to_remote(resolved, script);
}

MadeDevice make_device(const DeviceRequest& request) { return device_kind(request.name).make(request); }

}  // namespace ream::device
