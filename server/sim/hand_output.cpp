#include "sim/hand_output.hpp"

#include <algorithm>
#include <cmath>

#include "sim/model.hpp"

namespace ream::sim {
namespace {

/// A hand that feels less than this share of the simulated contact force is told less than the truth.
constexpr double felt_share = 0.99;

/// What bone and guide push back through the spring, hand N and N mm, world frame.
force::Wrench contact_on_hand(const Model& model, const Pose& world_from_tool, const ToolLoad& load) {
  const double per_hand = -1.0 / model.coupling.force_scale;
  return {world_from_tool.rotation * (per_hand * load.spring.force_n),
          world_from_tool.rotation * (per_hand * load.spring.torque_n_mm)};
}

/// The drive's housing is turned against the spindle, hand N mm, world frame.
Vec3 spindle_on_hand(const Model& model, const Pose& world_from_tool, double torque_n_mm) {
  return world_from_tool.rotation.col(2) * (-torque_n_mm / model.coupling.force_scale);
}

/// Energy in the coupling's spring, hand side, mJ.
double stored_mj(const Model& model, const ToolLoad& load) {
  const auto& c = model.coupling;
  const double per_hand = 1.0 / (c.force_scale * c.force_scale);
  return 0.5 * per_hand *
         (load.spring.force_n.squaredNorm() / c.stiffness_n_mm +
          load.spring.torque_n_mm.squaredNorm() / c.angular_stiffness_n_mm_rad);
}

/// What the reamer's shaking adds along its axis, hand N, world frame: fed forward, with a limit of its own.
Vec3 vibration_n(const Model& model, const Pose& world_from_tool, double vibration_g) {
  const force::VibrationSettings& vibration = model.settings.vibration;
  const double force_n = std::clamp(vibration_g * vibration.vibration_n_per_g, -vibration.vibration_max_n,
                                    vibration.vibration_max_n);
  return force_n * world_from_tool.rotation.col(2);
}

}  // namespace

double HandOutput::fade(bool stale, bool rests) noexcept {
  if (faded_ticks == 0) {
    fades_n = contact.force_n.norm();
    fades_n_mm = contact.torque_n_mm.norm();
  }
  if (stale || (faded_ticks > 0 && faded_ticks < fade_ticks))
    faded_ticks = rests ? fade_ticks : std::min(faded_ticks + 1, fade_ticks);
  else if (faded_ticks > 0) {
    faded_ticks = 0;
    start_up.restart();
  }
  return 1.0 - static_cast<double>(faded_ticks) / fade_ticks;
}

force::VibrationInput vibration_input(const Model& model, const ToolLoad& load,
                                      const record::TickReport& report) noexcept {
  const double speed_rad_s = std::abs(report.spindle_speed_rad_s);
  const double cut = force::cut_strength(report.thrust_n, speed_rad_s, load.edge_mm);
  const auto& specimen = model.vibration_of_specimen;
  return {speed_rad_s > 0.0,
          speed_rad_s,
          report.cutting,
          {report.share[0], report.share[1], report.share[2]},
          {cut * specimen[0], cut * specimen[1], cut * specimen[2]},
          report.paused};
}

device::DeviceOutput output_of(const record::TickReport& report) noexcept {
  device::DeviceOutput output{report.hand_force_n, report.hand_torque_n_mm, report.hand_vibration_n,
                              report.world_from_tool};
  output.tick = report.tick;
  output.link = report.link;
  output.engaged = report.engaged;
  output.thrust_n = report.thrust_n;
  output.vibration_g = report.vibration_g;
  return output;
}

void render(const Model& model, HandOutput& output, const Pose& world_from_tool, const ToolLoad& load,
            record::TickReport& report) noexcept {
  const force::DeviceLimits& limits = model.settings.limits;
  if (report.paused) output.start_up.restart();
  force::Wrench contact;
  Vec3 spindle_n_mm = Vec3::Zero(), shaking_n = Vec3::Zero();
  const bool renders = !report.paused && !report.failed_over;
  const double faded = output.fade(report.stale, !renders);
  const force::Wrench simulated = contact_on_hand(model, world_from_tool, load);
  if (renders) {
    contact = force::limited(simulated, limits);
    spindle_n_mm = spindle_on_hand(model, world_from_tool, report.spindle_torque_n_mm);
  }
  if (!model.virtual_mass) {
    output.energy.observe(report.world_from_handle);
    const double risen = report.paused ? 0.0 : output.start_up.next(load.unlimited_force_n);
    contact.force_n = faded * clamp_length(contact.force_n, risen * limits.force_max_n);
    contact.torque_n_mm = faded * clamp_length(contact.torque_n_mm, risen * limits.torque_max_n_mm);
    if (output.faded_ticks > 0) {  // the hand's last known way leads on for a moment, its force must not
      contact.force_n = clamp_length(contact.force_n, faded * output.fades_n);
      contact.torque_n_mm = clamp_length(contact.torque_n_mm, faded * output.fades_n_mm);
    }
    const double gain = faded * risen;
    contact = force::slewed(output.contact, contact, limits);
    if (model.settings.energy_guarded) contact = output.energy.allow(contact, stored_mj(model, load));
    spindle_n_mm = force::slewed(output.spindle_n_mm, Vec3(gain * spindle_n_mm), limits.torque_slew_n_mm);
    if (renders) shaking_n = gain * vibration_n(model, world_from_tool, report.vibration_g);
  }
  const double torque_left_n_mm = std::max(0.0, limits.torque_max_n_mm - contact.torque_n_mm.norm());
  spindle_n_mm = clamp_length(spindle_n_mm, torque_left_n_mm);
  output.contact = contact;
  output.spindle_n_mm = spindle_n_mm;
  report.hand_force_n = clamp_length(contact.force_n + shaking_n, limits.force_max_n);
  report.hand_vibration_n = report.hand_force_n - contact.force_n;
  report.hand_torque_n_mm = contact.torque_n_mm + spindle_n_mm;
  report.weakened |= renders && contact.force_n.norm() < felt_share * simulated.force_n.norm();
}

}  // namespace ream::sim
