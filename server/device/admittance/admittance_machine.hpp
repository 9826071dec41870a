#pragma once
#include "device/admittance/motion_limiter.hpp"
#include "device/haptic_device.hpp"

namespace ream::device {

/// Force in N of a mass in kg that is accelerated in mm/s^2.
inline constexpr double n_per_kg_mm_s2 = 1.0e-3;

/// What a machine that senses force and moves can do, in its own frame.
struct MachineLimits {
  MotionLimits motion;
  double sensor_range_n = 0.0;  ///< a force near this is clipped, and tells nothing
  /// Farther from where it was told to be than this the machine does not follow: an obstacle, or a fault.
  double following_error_max_mm = 0.0;
};

/// What a machine says once a tick. Frame: base, the machine's own.
struct MachineSense {
  Pose base_from_handle;            ///< measured
  Vec3 force_n = Vec3::Zero();      ///< of the hand on the handle as the sensor has it, not zeroed
  Vec3 torque_n_mm = Vec3::Zero();  ///< about the handle's origin, likewise
  double age_ms = 0.0;              ///< since the sensor said this
  bool spindle_on = false, paused = false, deadman = true;
};

/// What a driver of a real admittance device implements; AdmittanceDevice does the rest. From enable() on the
/// machine is position-controlled and holds where it was told to be. sense, move_to and session_paused are
/// called from the haptic thread: they never block, throw or allocate.
class AdmittanceMachine {
 public:
  virtual ~AdmittanceMachine() = default;
  virtual const DeviceTraits& traits() const noexcept = 0;
  virtual const MachineLimits& limits() const noexcept = 0;
  /// Connects; motors stay off. Throws Error unavailable.
  virtual void open() = 0;
  /// Motors on, holding where the machine stands. Throws Error unavailable.
  virtual void enable() = 0;
  /// Newest of position, sensor and buttons; `sense` keeps its last value when the status is not ok.
  virtual DeviceStatus sense(MachineSense& sense) noexcept = 0;
  /// Where to be at the end of this tick; within limits().motion. False: it cannot be told any more.
  virtual bool move_to(const Pose& base_from_handle) noexcept = 0;
  /// As HapticDevice::session_paused.
  virtual void session_paused(bool paused) noexcept = 0;
  /// The machine's own fastest stop; then it holds and takes no more orders until the next open(). Any
  /// thread and a signal handler may call it.
  virtual void stop() noexcept = 0;
  /// Motors off, brakes on. Harmless when it was never enabled.
  virtual void disable() noexcept = 0;
  virtual void close() noexcept = 0;
};

}  // namespace ream::device
