#pragma once
#include "device/haptic_device.hpp"
#include "record/recording.hpp"

namespace ream::record {

/// A recording as a device: gives handle poses and buttons of a range of ticks as they were used, in memory
/// before the first tick. What it is told is ignored.
class ReplayDevice final : public device::HapticDevice {
 public:
  /// Ticks first..last-1. Error invalid_input for a damaged chunk among them.
  ReplayDevice(const Recording& recording, uint32_t first, uint32_t last, device::DeviceTraits traits);

  const device::DeviceTraits& traits() const noexcept override { return traits_; }
  void open() override { next_ = 0; }
  void close() noexcept override {}
  device::DeviceStatus read(device::DeviceInput& input) noexcept override;
  device::DeviceStatus write(const device::DeviceOutput&) noexcept override {
    return device::DeviceStatus::ok;
  }

 private:
  struct Cause {
    QuantisedPose world_from_handle;
    bool spindle_on = false, paused = false;
  };
  std::vector<Cause> causes_;
  size_t next_ = 0;
  device::DeviceTraits traits_;
};

}  // namespace ream::record
