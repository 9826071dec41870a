#pragma once
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "device/network/remote_link.hpp"
#include "device/script/script.hpp"

namespace ream::device {

/// What a device is made for.
struct DeviceRequest {
  std::string name = "script";
  std::string profile;  ///< what it can render (device/profiles.hpp); empty: the script's
  const Script* script = nullptr;
  Pose world_from_plan;
  uint64_t random_seed = 1;
  std::filesystem::path data;  ///< where set-ups of devices are kept
};

struct MadeDevice {
  std::unique_ptr<HapticDevice> device;
  std::shared_ptr<RemoteLink> link;  ///< of devices that connect over the network; else empty
};

/// What is known of a device without opening it.
struct DeviceInfo {
  std::string name;
  std::string about;  ///< one line for people
  bool usable = true;
  std::string reason;  ///< why it is not usable, and what to do
  double force_max_n = 0.0;
  int degrees_of_freedom = 6;
};

/// A kind of device that sessions can have.
struct DeviceKind {
  std::string name;
  /// What it renders with (device/profiles.hpp) unless somebody says otherwise; empty: scripts say.
  std::string default_profile;
  /// `data`: where set-ups of devices are kept.
  std::function<DeviceInfo(const std::filesystem::path& data)> offer;
  std::function<MadeDevice(const DeviceRequest&)> make;
  /// Of the models that it can be; empty: any. What a profile says is what its hardware is made to render.
  std::vector<std::string> profiles = {};
};

/// Every kind, in the order in which people are shown them.
const std::vector<DeviceKind>& device_kinds();

/// One more, of a plug-in. To be called before there are sessions. Error conflict when its name is taken.
void add_device_kind(DeviceKind kind);

/// What is known of it that its profile says; usable.
DeviceInfo offer_of(const std::string& name, const std::string& about, const std::string& profile);

/// Whose limits a device that renders somebody's own hand has: asked for, or the script's, or `usual`.
std::string profile_of(const DeviceRequest& request, const std::string& usual);

/// Error invalid_input, saying which fit, for a profile that is none of `fitting`.
void require_fitting_profile(const std::string& device, const std::vector<std::string>& fitting,
                             const std::string& profile);

/// A device that speaks of its own frame, made one of the world that begins before the planned entry.
std::unique_ptr<HapticDevice> mapped(const DeviceRequest& request, std::unique_ptr<HapticDevice> device);

/// Error invalid_input, listing the names, for an unknown one.
const DeviceKind& device_kind(const std::string& name);

/// Puts into a script what a session with this device leaves to it: whose limits the hand feels through, and
/// with a script that leaves it open the force scale. `profile`: asked for, or empty for the usual one.
/// Errors: invalid_input for an unknown device or profile, and for a profile beside a script that says its
/// own; for a profile that is not of the device.
void settle_for_device(const std::string& device, const std::string& profile, Script& script);

/// Errors: those of device_kind and of the kind.
MadeDevice make_device(const DeviceRequest& request);

/// Devices on this computer or behind a service that this program connects to by itself, with set-ups in the
/// data folder; server/device/GUIDE.md.
std::vector<DeviceKind> real_device_kinds();

}  // namespace ream::device
