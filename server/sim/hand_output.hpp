#pragma once
#include "device/haptic_device.hpp"
#include "force/hand_safety.hpp"
#include "force/spindle.hpp"
#include "force/vibration/vibration_player.hpp"
#include "record/tick_report.hpp"

namespace ream::sim {

struct Model;

/// What acts on the tool at the end of a tick: simulated N and N mm, tool frame, about the tool's origin.
struct ToolLoad {
  force::Wrench spring;        ///< that the coupling puts on the tool
  force::SpindleLoad spindle;  ///< what holds the spindle back
  bool cuts = false;           ///< pressed enough, and turning
  double edge_mm = 0.0;        ///< cutting edge that is engaged, see force::EngagedBone
  /// What the spring between handle and tool would put on the hand without any limit, hand N.
  double unlimited_force_n = 0.0;
  double area_mm2 = 0.0;  ///< of the cutting surface, that touches bone
};

/// What of a session's hand output carries over from tick to tick.
struct HandOutput {
  explicit HandOutput(double start_up_ramp_s) : start_up(start_up_ramp_s) {}

  /// Of this tick: 1, falling to 0 within fade_ticks of a stale pose, and so on to the end even if new poses
  /// come before. Then the start-up ramp begins anew, as the hand may be anywhere. A tick that `rests`,
  /// without any force, ends the fading at once: the force that it took away does not come back to fade.
  double fade(bool stale, bool rests) noexcept;
  static constexpr int fade_ticks = 20;

  force::StartUpRamp start_up;
  force::EnergyGuard energy;
  /// Of the last tick, world frame: what bone and guide do to the hand, and what the spindle does beside it.
  force::Wrench contact;
  Vec3 spindle_n_mm = Vec3::Zero();
  int faded_ticks = 0;      ///< since a pose was too old
  double fades_n = 0.0;     ///< contact's force when it became so: what fades is no more than that
  double fades_n_mm = 0.0;  ///< and its torque
};

/// What a tick says about vibration, as the tick itself plays it.
force::VibrationInput vibration_input(const Model& model, const ToolLoad& load,
                                      const record::TickReport& report) noexcept;

/// What is written to a device after a tick.
device::DeviceOutput output_of(const record::TickReport& report) noexcept;

/// From what acts on the tool to what the hand feels. Contact: the force scale, the device's largest force
/// and torque, the start-up ramp and the fading of a stale pose, the slew limit, the energy guard, in this
/// order. Beside it, as they are a
/// motor's work and not the bone's: the spindle's reaction, within the torque that contact leaves, and
/// vibration, which has a limit of its own and with contact stays within the device's. An admittance device
/// renders motion, so for it this only tells what the hand holds. Fills the report's hand force and torque;
/// zero while paused. Called once in every tick, whatever happens.
void render(const Model& model, HandOutput& output, const Pose& world_from_tool, const ToolLoad& load,
            record::TickReport& report) noexcept;

}  // namespace ream::sim
