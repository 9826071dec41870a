#pragma once
#include <optional>
#include <string>

#include "geometry/pose.hpp"

namespace ream::device {

/// Impedance devices give a pose and take a force; admittance devices give the hand's force and take a pose.
enum class Causality { impedance, admittance };

/// What a device can render, hand side, and who it is. See device/profiles.hpp for the devices we know.
struct DeviceTraits {
  std::string name;
  Causality causality = Causality::impedance;
  double force_max_n = 0.0;      ///< continuous
  double torque_max_n_mm = 0.0;  ///< 0: no torque
  double stiffness_max_n_mm = 0.0;
  double angular_stiffness_max_n_mm_rad = 0.0;
  double damping_max_n_s_mm = 0.0;   ///< that the device renders without chatter; 0: not published
  double workspace_radius_mm = 0.0;  ///< of the ball that its handle reaches
  double start_up_ramp_s = 0.0;      ///< over which force rises from nothing after the start
  double vibration_max_n = 0.0;      ///< amplitude that may be added to the contact force
  double effective_mass_kg = 0.0;    ///< admittance devices: virtual mass that the hand moves; else 0
  bool energy_guarded = true;        ///< false: stiffer than can be held passive, for scripts only
  int degrees_of_freedom = 6;        ///< sensed
  std::string profile = "ideal";     ///< name in device/profiles.hpp
};

struct DeviceInput {
  Pose world_from_handle;                ///< sensed; of admittance devices only the first one counts
  Vec3 hand_force_n = Vec3::Zero();      ///< of the hand on the device, world frame; admittance devices only
  Vec3 hand_torque_n_mm = Vec3::Zero();  ///< about the tool's origin, world frame; admittance devices only
  bool spindle_on = false;
  bool paused = false;
};

struct DeviceOutput {
  Vec3 force_n = Vec3::Zero();      ///< on the hand, world frame
  Vec3 torque_n_mm = Vec3::Zero();  ///< on the hand about the handle's origin, world frame
  Vec3 vibration_n = Vec3::Zero();  ///< the part of force_n that is vibration
  std::optional<Pose> world_from_tool =
      std::nullopt;  ///< where an admittance device moves to; empty: it stays
};

enum class DeviceStatus {
  ok,
  finished,  ///< a script or replay has come to its end
  stale,     ///< nothing new from the hardware for too long
  fault,     ///< the device cannot be used any more
};

/// A thing held in the hand: gives a pose, takes a force, once a millisecond. read and write are called from
/// the haptic thread: they never block, throw or allocate. The owner opens it before the first tick and
/// closes it after the last; close() leaves the device without force.
class HapticDevice {
 public:
  virtual ~HapticDevice() = default;
  virtual const DeviceTraits& traits() const noexcept = 0;
  /// Throws Error unavailable when the hardware cannot be used.
  virtual void open() = 0;
  virtual void close() noexcept = 0;
  /// Newest input; `input` keeps its last value when the status is not ok.
  virtual DeviceStatus read(DeviceInput& input) noexcept = 0;
  virtual DeviceStatus write(const DeviceOutput& output) noexcept = 0;
};

}  // namespace ream::device
