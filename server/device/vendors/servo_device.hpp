#pragma once
#include <atomic>
#include <string>
#include <thread>

#include "device/network/remote_link.hpp"
#include "device/vendors/servo.hpp"

namespace ream::device {

/// A haptic device behind a driver that runs on a thread of its own: the haptic thread only exchanges slots
/// with it. Poses and forces are in the device's frame. A device that goes away lets its last pose grow older
/// (the session rests) and is opened again every half second; one that cannot be used any more is
/// DeviceStatus::fault.
class ServoDevice final : public HapticDevice {
 public:
  ServoDevice(DeviceTraits traits, std::unique_ptr<Servo> servo, int64_t (*now_ns)() = steady_ns);
  ~ServoDevice() override;

  const DeviceTraits& traits() const noexcept override { return traits_; }
  /// Waits until the driver has opened. Errors: those of Servo::open.
  void open() override;
  /// Returns once the hardware is without force and closed.
  void close() noexcept override;
  DeviceStatus read(DeviceInput& input) noexcept override;
  DeviceStatus write(const DeviceOutput& output) noexcept override;
  /// Waits 10 ms of its clock at most for the driver to have rendered nothing, so that a process that dies
  /// thereafter leaves no force behind where its driver still runs.
  void take_force_away() noexcept override;
  void use_priority(int fifo) noexcept override { fifo_priority_ = fifo; }
  void session_paused(bool) noexcept override {}
  double closing_ms() const noexcept override { return 0.0; }

 private:
  void apply_priority() const noexcept;
  void run();
  void serve();
  void disconnect() noexcept;
  bool wait_before_retry() noexcept;

  DeviceTraits traits_;
  const std::shared_ptr<RemoteLink> link_ = std::make_shared<RemoteLink>();
  RemoteEnd end_;
  ServoEnd servo_end_;
  const std::unique_ptr<Servo> servo_;
  std::thread thread_;
  int fifo_priority_ = 0;  ///< that it asks for; 0: none
  std::atomic<bool> leaving_{false}, unusable_{false};
  std::atomic<bool> serving_{false};        ///< the driver turns: what is taken away is soon gone
  std::atomic<bool> without_force_{false};  ///< a turn has begun since the force was taken away
  std::atomic<int> opened_{0};              ///< 0: not yet, 1: yes, -1: no
  std::string refusal_;                     ///< why not; before opened_
};

}  // namespace ream::device
