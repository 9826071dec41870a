#pragma once
#include <memory>

#include "core/clock.hpp"
#include "device/haptic_device.hpp"
#include "device/network/remote_link.hpp"

namespace ream::device {

/// A haptic device that some client connects over the network with. Its poses and forces are in the device's
/// own frame. A new pose is not jumped to: the handle glides there within the usual time between two, which
/// delays a sender of 1 kHz by no more than one message and gives a slow or jittery one no steps.
class NetworkDevice final : public HapticDevice {
 public:
  /// `profile`: name in device/profiles.hpp of an impedance device. Error invalid_input for others.
  NetworkDevice(const std::string& profile, std::shared_ptr<RemoteLink> link,
                int64_t (*now_ns)() = steady_ns);

  const DeviceTraits& traits() const noexcept override { return traits_; }
  void open() override;
  void close() noexcept override;
  DeviceStatus read(DeviceInput& input) noexcept override;
  DeviceStatus write(const DeviceOutput& output) noexcept override;
  void take_force_away() noexcept override { end_.take_force_away(); }
  void session_paused(bool) noexcept override {}
  double closing_ms() const noexcept override { return 0.0; }
  void use_priority(int) noexcept override {}

 private:
  void glide_to(const Pose& pose, int64_t now_ns) noexcept;
  Pose gliding(int64_t now_ns) const noexcept;

  DeviceTraits traits_;
  RemoteEnd end_;
  RemoteInput newest_;
  uint64_t connection_ = 0;  ///< that the poses below are of; 0: there is none yet
  Pose from_, to_;
  int64_t since_ns_ = 0, arrived_ns_ = 0;  ///< when the glide began, and when `to_` came
  double interval_ns_ = 0.0;               ///< the usual time between two messages
};

}  // namespace ream::device
