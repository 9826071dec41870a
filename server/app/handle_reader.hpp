#pragma once
#include <atomic>
#include <optional>
#include <thread>

#include "core/latest_slot.hpp"
#include "device/device_setup.hpp"
#include "device/haptic_device.hpp"

namespace ream::app {

/// Reads a device once a millisecond on a thread of its own and gives it no force, while somebody asks where
/// its handle is. Opens the device, and closes it at the end. Errors: those of open().
class HandleReader {
 public:
  /// `device` speaks of the world as a MappedDevice with `setup` does that began at `world_from_start`.
  HandleReader(device::HapticDevice& device, const device::DeviceSetup& setup, const Pose& world_from_start);
  ~HandleReader();
  HandleReader(const HandleReader&) = delete;
  HandleReader& operator=(const HandleReader&) = delete;

  /// Whether the device answers now.
  bool answers() const noexcept { return answers_.load(std::memory_order_acquire); }
  /// In the device's own frame but for where its origin is, mm. One reader. Error unavailable when the device
  /// does not answer.
  Vec3 place_mm();

 private:
  struct Place {
    double mm[3] = {0.0, 0.0, 0.0};
  };
  void read() noexcept;

  device::HapticDevice& device_;
  const Mat3 device_from_world_mm_;
  LatestSlot<Place> newest_;
  Place last_;
  std::atomic<bool> answers_{false}, leaving_{false};
  std::optional<device::DeviceGuard> guard_;
  std::thread thread_;
};

}  // namespace ream::app
