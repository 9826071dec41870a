#include "sim/hand_output.hpp"

#include <algorithm>

#include "sim/model.hpp"

namespace ream::sim {
namespace {

/// The tool's load as it comes to the hand, hand N and N mm, world frame: bone pushes back through the
/// spring, and the housing of the drive is turned against the spindle.
force::Wrench on_hand(const Model& model, const Pose& world_from_tool, const ToolLoad& load) {
  const double per_hand = -1.0 / model.coupling.force_scale;
  return {world_from_tool.rotation * (per_hand * load.spring.force_n),
          world_from_tool.rotation *
              (per_hand * (load.spring.torque_n_mm + load.spindle_torque_n_mm * Vec3::UnitZ()))};
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

void render(const Model& model, HandOutput& output, const Pose& world_from_tool, const ToolLoad& load,
            record::TickReport& report) noexcept {
  const force::DeviceLimits& limits = model.settings.limits;
  force::Wrench wanted;
  if (report.paused)
    output.start_up.restart();
  else if (!report.failed_over)
    wanted = force::limited(on_hand(model, world_from_tool, load), limits);
  Vec3 shaking_n = Vec3::Zero();
  if (!model.virtual_mass) {
    output.energy.observe(report.world_from_handle);
    const double gain = report.paused ? 0.0 : output.start_up.next(wanted.force_n.norm());
    wanted = force::slewed(output.rendered, wanted.scaled(gain), limits);
    wanted = output.energy.allow(wanted, stored_mj(model, load));
    if (!report.failed_over) shaking_n = gain * vibration_n(model, world_from_tool, report.vibration_g);
  }
  output.rendered = wanted;
  report.hand_force_n = force::limited(Vec3(wanted.force_n + shaking_n), limits.force_max_n);
  report.hand_torque_n_mm = wanted.torque_n_mm;
}

}  // namespace ream::sim
