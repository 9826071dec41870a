#pragma once
#include <array>
#include <atomic>
#include <cstdint>
#include <memory>

#include "core/latest_slot.hpp"
#include "device/haptic_device.hpp"

namespace ream::device {

/// The newest thing that a device's client said; see proto/device.fbs.
/// Plain numbers only: it goes through a slot.
struct RemoteInput {
  int64_t arrived_ns = 0;   ///< steady_ns()
  uint64_t connection = 0;  ///< on which it came, counted from 1
  bool steering = false;    ///< which of the two kinds below it is
  // Handle: the device's own frame.
  std::array<double, 4> rotation_wxyz{1, 0, 0, 0};
  std::array<double, 3> place_mm{}, hand_force_n{};
  // Steering: world frame.
  std::array<double, 3> sideways_mm{};  ///< from the planned entry
  std::array<double, 3> lean{};         ///< all zero: along the planned axis
  double push_n = 0.0;
  DriveControls drive;
  bool spindle_on = false, paused = false, clutch = false, deadman = true;
};

/// A force older than this is not passed on to a client.
inline constexpr int64_t output_too_old_ns = 20'000'000;

/// What goes back to it.
struct RemoteOutput {
  int64_t written_ns = 0;   ///< steady_ns() of the tick; see output_too_old_ns
  uint64_t connection = 0;  ///< whose input it answers to; the force is for nobody else
  uint32_t tick = 0;
  LinkState link = LinkState::lost;
  bool engaged = false;
  std::array<double, 3> force_n{}, torque_n_mm{};
  double thrust_n = 0.0, vibration_g = 0.0;
};

/// What is between the haptic thread and the thread that talks to a device over a network: newest-wins both
/// ways, nobody waits. The device (NetworkDevice, the steered hand) is on one side, the socket
/// (DeviceSocket) on the other.
struct RemoteLink {
  LatestSlot<RemoteInput> input;              ///< written by the socket's side, read by the haptic thread
  LatestSlot<RemoteOutput> output;            ///< the other way
  std::atomic<bool> force_taken_away{false};  ///< take_force_away() was called: nothing but zero goes out
  /// Counts of messages, and the way there and back in us (-1: not known): written by the socket's side.
  std::atomic<uint64_t> received{0}, missing{0}, late{0}, refused{0}, connections{0};
  std::atomic<int64_t> rtt_us{-1};
};

/// The haptic thread's end of a link, which every device that connects over the network has: it takes the
/// newest input and says how old it is, and writes what goes back. Wait-free.
class RemoteEnd {
 public:
  /// `clock_ns`: the clock of RemoteLink's times.
  RemoteEnd(std::shared_ptr<RemoteLink> link, int64_t (*clock_ns)())
      : link_(std::move(link)), now_ns_(clock_ns) {}

  /// Forgets what was said before; force may go out.
  void open() noexcept;
  /// Looks for news and takes it into `input`. False: there is none. A new connection makes itself known by
  /// one look without news at which the age is infinite, as its device may be held elsewhere.
  bool take(RemoteInput& input) noexcept;
  /// Of the newest input at the last look; infinite before the first.
  double age_ms() const noexcept { return age_ms_; }
  int64_t now_ns() const noexcept { return now_ns_(); }

  /// `output` goes to the connection whose input was taken last.
  void write(const DeviceOutput& output) noexcept;
  /// From any thread: no force goes out any more until open().
  void take_force_away() noexcept { link_->force_taken_away.store(true, std::memory_order_release); }

 private:
  const std::shared_ptr<RemoteLink> link_;
  int64_t (*const now_ns_)();
  RemoteInput newest_;
  uint64_t answered_ = 0;  ///< connection whose input was taken last
  bool broken_ = false;    ///< the newest input is the first of its connection and has not been taken
  double age_ms_ = 0.0;
};

}  // namespace ream::device
