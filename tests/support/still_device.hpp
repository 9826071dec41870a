#pragma once
#include "device/haptic_device.hpp"

namespace ream::test {

/// A device that always answers and does nothing; what is to be different is derived.
struct StillDevice : device::HapticDevice {
  const device::DeviceTraits& traits() const noexcept override { return device_traits; }
  void open() override {}
  void close() noexcept override {}
  device::DeviceStatus read(device::DeviceInput&) noexcept override { return device::DeviceStatus::ok; }
  device::DeviceStatus write(const device::DeviceOutput&) noexcept override {
    return device::DeviceStatus::ok;
  }
  void session_paused(bool) noexcept override {}
  void take_force_away() noexcept override {}
  double closing_ms() const noexcept override { return 0.0; }
  void use_priority(int) noexcept override {}
  device::DeviceTraits device_traits;
};

}  // namespace ream::test
