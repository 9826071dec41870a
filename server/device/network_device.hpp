#pragma once
#include <memory>

#include "core/clock.hpp"
#include "device/haptic_device.hpp"
#include "device/remote_link.hpp"

namespace ream::device {

/// How old the newest input of a link is, ms: infinite before the first and for one read after each new
/// connection, as that may hold its device elsewhere. Also keeps the link's state.
class InputAge {
 public:
  explicit InputAge(const StaleLimits& limits) : limits_(limits) {}
  /// Looks for news and takes it into `input`. True: there is news to be used.
  bool take(RemoteLink& link, RemoteInput& input, int64_t now_ns) noexcept;
  double age_ms() const noexcept { return age_ms_; }
  LinkState state() const noexcept;

 private:
  StaleLimits limits_;
  RemoteInput waiting_;
  bool broken_ = false;
  double age_ms_ = 0.0;
};

/// `output` as it goes back over the link.
RemoteOutput remote_output(const DeviceOutput& output, LinkState state, int64_t now_ns) noexcept;

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
  void take_force_away() noexcept override { link_->force_taken_away.store(true, std::memory_order_release); }

 private:
  void glide_to(const Pose& pose, int64_t now_ns) noexcept;
  Pose gliding(int64_t now_ns) const noexcept;

  DeviceTraits traits_;
  const std::shared_ptr<RemoteLink> link_;
  int64_t (*const now_ns_)();
  InputAge age_;
  RemoteInput newest_;
  uint64_t connection_ = 0;  ///< that the poses below are of; 0: there is none yet
  Pose from_, to_;
  int64_t since_ns_ = 0, arrived_ns_ = 0;  ///< when the glide began, and when `to_` came
  double between_ns_ = 0.0;                ///< the usual time between two messages
};

}  // namespace ream::device
