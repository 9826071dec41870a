#pragma once
#include <memory>

#include "core/clock.hpp"
#include "device/haptic_device.hpp"
#include "device/network/remote_link.hpp"

namespace ream::device {

/// What a device says of its handle, in its own frame.
struct ServoState {
  Pose device_from_handle;
  bool spindle_on = false, paused = false, clutch = false, deadman = true;
};

/// What a device is to render, in its own frame.
struct ServoForce {
  Vec3 force_n = Vec3::Zero(), torque_n_mm = Vec3::Zero();
  bool is_zero() const noexcept { return force_n.isZero(0.0) && torque_n_mm.isZero(0.0); }
};

/// The hardware's end of a link; the haptic thread's is RemoteEnd. Whatever runs at the hardware's pace (a
/// thread of ours, a vendor's callback) asks it what may be rendered now, and tells it what was sensed. It
/// alone decides what goes out, for every driver alike. Wait-free; one thread at a time.
class ServoEnd {
 public:
  /// Forces and torques are cut to these, keeping their direction. `clock_ns`: the clock of RemoteLink's
  /// times.
  ServoEnd(std::shared_ptr<RemoteLink> link, double force_max_n, double torque_max_n_mm,
           int64_t (*clock_ns)());

  /// A device is about to be opened: its poses are of a new connection, and no force is for it yet.
  void begin() noexcept;
  /// The newest force, cut to the limits. Zero when it is older than output_too_old_ns, was taken away, is
  /// not finite, or answers to poses of an earlier connection.
  ServoForce force() noexcept;
  /// False, and nothing is said, for a pose that is not finite, no rotation, or
  /// further away than 2 m. `sensed_ns`: a time
  /// no later than when it was sensed.
  bool report(const ServoState& state, int64_t sensed_ns) noexcept;

  /// Waits until there is a new force, at most so long; looks at it every 50 us near the time when it is due,
  /// as a haptic thread wakes nobody.
  void await_force(int64_t max_ns) noexcept;
  /// The hardware renders less than it did (warm motors), or again all that it can.
  void limit_force(double force_max_n) noexcept { force_max_n_ = force_max_n; }
  int64_t now_ns() const noexcept { return now_ns_(); }

  static constexpr double max_distance_mm = 2000.0;

 private:
  bool poll_output() noexcept;

  const std::shared_ptr<RemoteLink> link_;
  double force_max_n_;
  const double torque_max_n_mm_;
  int64_t (*const now_ns_)();
  uint64_t connection_ = 0;
  RemoteOutput newest_;
  int64_t due_ns_ = 0;  ///< when the next force is expected
};

/// A driver: how one kind of hardware is opened, exchanged with and let go. All calls come from one thread,
/// which is not the haptic one and may wait.
class Servo {
 public:
  virtual ~Servo() = default;
  /// Makes the hardware ready, without force. Error unavailable, in one line that says what to do, when it
  /// cannot be had now. After it, a driver may use `end` from another thread until close().
  virtual void open(ServoEnd& end) = 0;
  /// About one millisecond: renders end.force() and tells what was sensed. Error unavailable when the
  /// hardware has gone, so that it is closed and opened again; any other kind: it cannot be used any more.
  virtual void turn(ServoEnd& end) = 0;
  /// Zero force, force off, closed, in that order; also after a failed open() or turn().
  virtual void close() noexcept = 0;
  /// Whether a thread of the hardware's own asks for the force between open() and close(). Nobody else may
  /// ask then: one thread alone reads the newest force. turn() waits for that thread by itself.
  virtual bool takes_force_elsewhere() const noexcept = 0;
};

}  // namespace ream::device
