#pragma once
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "geometry/pose.hpp"

namespace ream::device {

/// How far what a device last said may still be trusted; see StaleLimits.
enum class LinkState : uint8_t { fresh, held, fading, lost };

/// One word for people and REST: "fresh", "held", "fading", "lost".
inline const char* to_text(LinkState state) noexcept {
  constexpr std::array<const char*, 4> names{"fresh", "held", "fading", "lost"};
  return names[static_cast<size_t>(state)];
}

/// Impedance devices give a pose and take a force; admittance devices give the hand's force and take a pose.
enum class Causality { impedance, admittance };

/// How old a pose may get before the hand is no longer trusted, ms (reference for both rows: haptic devices'
/// firmware gives up after 32 ms; a browser's frames come every 17 ms).
struct StaleLimits {
  double hold_ms = 5.0;   ///< up to here the last pose is as good as a new one
  double fade_ms = 10.0;  ///< from here on the force falls to nothing within 20 ms
  double lost_ms = 50.0;  ///< from here on the session rests until poses come again
};
constexpr StaleLimits haptic_stale_limits{5.0, 10.0, 50.0};
constexpr StaleLimits browser_stale_limits{100.0, 100.0, 250.0};

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
  double handle_mass_kg = 0.0;    ///< impedance devices: what a hand moves with the handle, apparent; else 0
  bool energy_guarded = true;     ///< false: stiffer than can be held passive, for scripts only
  int degrees_of_freedom = 6;     ///< sensed
  std::string profile = "ideal";  ///< name in device/profiles.hpp
  StaleLimits stale;
  bool simulated = false;  ///< nobody's hand is in it: a loop that stands still harms no one
  /// A device that has been told nothing for so long lets go by itself; infinite: it never does.
  double force_expires_ms = std::numeric_limits<double>::infinity();
};

/// What is asked of drive and irrigation, beside that the spindle turns at all.
struct DriveControls {
  uint8_t trigger = 255;  ///< how far it is pressed while the spindle is on; 255: full speed
  bool reversed = false;  ///< the spindle turns the other way, in which lips do not cut
  bool irrigating = false;
  bool operator==(const DriveControls&) const = default;
};

struct DeviceInput {
  Pose world_from_handle;                ///< sensed; of admittance devices only the first one counts
  Vec3 hand_force_n = Vec3::Zero();      ///< of the hand on the device, world frame; admittance devices only
  Vec3 hand_torque_n_mm = Vec3::Zero();  ///< about the tool's origin, world frame; admittance devices only
  double age_ms = 0.0;  ///< since the hardware said all this; infinite: it has never said anything
  // Buttons, true while they are pressed.
  bool spindle_on = false;
  DriveControls drive;
  bool paused = false;
  bool clutch = false;  ///< the hand moves without the tool
  bool deadman = true;  ///< somebody holds the handle; true of devices that cannot tell
  bool stale = false;   ///< too old to push against: set by sim::PoseWatchdog, and by a replay of it
};

struct DeviceOutput {
  Vec3 force_n = Vec3::Zero();      ///< on the hand, world frame
  Vec3 torque_n_mm = Vec3::Zero();  ///< on the hand about the handle's origin, world frame
  Vec3 vibration_n = Vec3::Zero();  ///< the part of force_n that is vibration
  std::optional<Pose> world_from_tool =
      std::nullopt;  ///< where an admittance device moves to; empty: it stays
  // What a device may show beside what it renders.
  uint32_t tick = 0;
  LinkState link = LinkState::lost;  ///< how far what it said was trusted
  bool engaged = false;
  double thrust_n = 0.0;  ///< simulated
  double vibration_g = 0.0;
};

enum class DeviceStatus {
  ok,
  finished,  ///< a script or replay has come to its end
  stale,     ///< nothing new from the hardware for too long
  fault,     ///< the device cannot be used any more
};

/// A thing held in the hand: gives a pose, takes a force, once a millisecond. read and write are called from
/// the haptic thread: they never block, throw or allocate. The owner opens it before the first tick and
/// closes it after the last; close() leaves the device without force. Nothing here has a default body: a
/// driver that forgot to take its force away would say so only in somebody's hand.
class HapticDevice {
 public:
  virtual ~HapticDevice() = default;
  virtual const DeviceTraits& traits() const noexcept = 0;
  /// Throws Error unavailable when the hardware cannot be used.
  virtual void open() = 0;
  virtual void close() noexcept = 0;
  /// Whether the session is paused by somebody else than the hand; said before every read, from the haptic
  /// thread. A simulated hand then rests and its script waits; of all others the loop takes the force away as
  /// for their own pause button.
  virtual void session_paused(bool paused) noexcept = 0;
  /// Newest input; `input` keeps its last value when the status is not ok.
  virtual DeviceStatus read(DeviceInput& input) noexcept = 0;
  virtual DeviceStatus write(const DeviceOutput& output) noexcept = 0;
  /// Takes all force away at once and for good (until the next open()), where the device allows that from
  /// outside its loop. Any thread may call it beside the others, and a signal handler of a crash: it does
  /// nothing that is not safe there.
  virtual void take_force_away() noexcept = 0;
  /// How long write() and close() at the end may take together, as a machine that moves is braked to rest
  /// first.
  virtual double closing_ms() const noexcept = 0;
  /// Threads of the device's own that exchange its forces ask for this SCHED_FIFO priority from the next
  /// open() on, and take what they get; 0: for none.
  virtual void use_priority(int fifo) noexcept = 0;
};

/// Leaves an open device without force and closed, whatever happens in between.
class DeviceGuard {
 public:
  explicit DeviceGuard(HapticDevice& device) : device_(device) {}
  ~DeviceGuard() {
    device_.write({});
    device_.close();
  }
  DeviceGuard(const DeviceGuard&) = delete;
  DeviceGuard& operator=(const DeviceGuard&) = delete;

 private:
  HapticDevice& device_;
};

}  // namespace ream::device
