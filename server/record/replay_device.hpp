#pragma once
#include "device/haptic_device.hpp"
#include "record/recording.hpp"

namespace ream::record {

/// What a device said in a recorded tick, as it was used.
device::DeviceInput input_of(const ops::Tick& tick);

/// A recording as a device: gives handle poses and buttons of a range of ticks as they were used, in memory
/// before the first tick (52 bytes each). What it is told is ignored. A state that it drives needs
/// handle_given, and failed_over_tick where the recording has one.
class ReplayDevice final : public device::HapticDevice {
 public:
  /// What the hand did in a tick, as ops::Tick has it.
  struct Cause {
    QuantisedPose world_from_handle;
    uint32_t flags = 0;
  };

  ReplayDevice(std::vector<Cause> causes, device::DeviceTraits traits);
  /// Ticks first..last-1. Error invalid_input for a damaged chunk among them.
  ReplayDevice(const Recording& recording, uint32_t first, uint32_t last, device::DeviceTraits traits);

  const device::DeviceTraits& traits() const noexcept override { return traits_; }
  void open() override { next_ = 0; }
  void close() noexcept override {}
  device::DeviceStatus read(device::DeviceInput& input) noexcept override;
  device::DeviceStatus write(const device::DeviceOutput&) noexcept override {
    return device::DeviceStatus::ok;
  }
  // Recorded inputs say when they were paused, and nobody feels a force.
  void session_paused(bool) noexcept override {}
  void take_force_away() noexcept override {}
  double closing_ms() const noexcept override { return 0.0; }
  void use_priority(int) noexcept override {}

 private:
  std::vector<Cause> causes_;
  size_t next_ = 0;
  device::DeviceTraits traits_;
};

}  // namespace ream::record
