#pragma once
#include "device/haptic_device.hpp"

namespace ream::device {

/// Leaves an open device without force and closed, whatever happens in between.
class DeviceGuard {
 public:
  explicit DeviceGuard(HapticDevice& device) : device_(device) {}
  ~DeviceGuard() {
    device_.write({});
    device_.close();
  }
  DeviceGuard(const DeviceGuard&) = delete;
  DeviceGuard& operator=(const DeviceGuard&) = delete;

 private:
  HapticDevice& device_;
};

}  // namespace ream::device
