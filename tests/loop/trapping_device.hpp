#pragma once
#include <functional>
#include <limits>

#include "device/haptic_device.hpp"
#include "loop/traps.hpp"

namespace ream::test {

/// Passes everything on to a device and watches its loop: from the first read() to close(), which are called
/// by the loop's own thread, the traps are armed. It also presses buttons that scripts do not know.
class TrappingDevice final : public device::HapticDevice {
 public:
  explicit TrappingDevice(device::HapticDevice& inner) : inner_(inner) {}
  const device::DeviceTraits& traits() const noexcept override { return inner_.traits(); }
  void open() override { inner_.open(); }
  void close() noexcept override {
    Traps::disarm();
    inner_.close();
  }
  device::DeviceStatus read(device::DeviceInput& input) noexcept override {
    if (tick == 0) Traps::arm();
    const device::DeviceStatus status = inner_.read(input);
    if (during_read) during_read(input);
    ++tick;
    return status;
  }
  device::DeviceStatus write(const device::DeviceOutput& output) noexcept override {
    largest_force_n = std::max(largest_force_n, output.force_n.norm());
    return inner_.write(output);
  }
  void session_paused(bool paused) noexcept override { inner_.session_paused(paused); }
  void take_force_away() noexcept override { inner_.take_force_away(); }
  double closing_ms() const noexcept override { return inner_.closing_ms(); }
  void use_priority(int fifo) noexcept override { inner_.use_priority(fifo); }

  std::function<void(device::DeviceInput&)> during_read;
  int tick = 0;
  double largest_force_n = 0.0;

 private:
  device::HapticDevice& inner_;
};

}  // namespace ream::test
