#pragma once
#include <memory>

#include "device/device_setup.hpp"
#include "device/haptic_device.hpp"

namespace ream::device {

/// A device that speaks of its own frame, made one that speaks of the world, with what hands need beside:
/// - While the clutch is pressed, nobody holds the handle, the hand or the session pauses or the device has
///   stopped answering, the handle rests where it is (paused; without a hand on it, with the spindle off).
///   From there it goes on, so it never jumps: only what the hand moves from then on counts. The same goes
///   for a jump that no hand can make.
/// - Turns are absolute: the tool points as the handle does. After a rest it turns there no faster than
///   turn_rate_rad_s.
/// - A pose that is not a number counts as nothing said: the last good one grows older.
class MappedDevice final : public HapticDevice {
 public:
  /// `device` gives poses and hand forces in its own frame and takes forces there. `world_from_start`: where
  /// the tool is at first, z into the bone (the plan's axis).
  MappedDevice(std::unique_ptr<HapticDevice> device, const DeviceSetup& setup, const Pose& world_from_start);

  /// Those of the device as the world sees them, lengths and torques enlarged by the scale.
  const DeviceTraits& traits() const noexcept override { return traits_; }
  void open() override;
  void close() noexcept override { device_->close(); }
  DeviceStatus read(DeviceInput& input) noexcept override;
  DeviceStatus write(const DeviceOutput& output) noexcept override;
  void session_paused(bool paused) noexcept override;
  void take_force_away() noexcept override { device_->take_force_away(); }
  double closing_ms() const noexcept override { return device_->closing_ms(); }
  void use_priority(int fifo) noexcept override { device_->use_priority(fifo); }

  /// Faster than any hand, mm/s of the device: what moves more between two reads has not been moved by one.
  static constexpr double max_hand_speed_mm_s = 5000.0;
  static constexpr double turn_rate_rad_s = 2.0;

 private:
  /// `since_ms`: how long the hand may have been moving since the last read.
  void follow(bool rests, double since_ms) noexcept;
  void turn_to(const Mat3& world_from_tool) noexcept;
  Vec3 mapped_mm(const Vec3& device_mm) const noexcept;

  const std::unique_ptr<HapticDevice> device_;
  const Mat3 world_from_device_, handle_from_tool_;
  const double scale_;
  const Pose world_from_start_;
  DeviceTraits traits_;
  DeviceInput sensed_;      ///< by the device, its last good word
  Pose world_from_handle_;  ///< as the world has it
  Vec3 offset_mm_ = Vec3::Zero();
  Vec3 last_mm_ = Vec3::Zero();  ///< device frame
  double silent_ms_ = 0.0;       ///< since the last good pose
  bool rests_ = true, turning_ = true, session_paused_ = false;
};

}  // namespace ream::device
