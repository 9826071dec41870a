#include "sim/hand_output.hpp"

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

}  // namespace

void render(const Model& model, HandOutput& output, const Pose& world_from_tool, const ToolLoad& load,
            record::TickReport& report) noexcept {
  const force::DeviceLimits& limits = model.settings.limits;
  force::Wrench wanted;
  if (report.paused)
    output.start_up.restart();
  else if (!report.failed_over)
    wanted = force::limited(on_hand(model, world_from_tool, load), limits);
  if (!model.virtual_mass) {
    output.energy.observe(report.world_from_handle);
    if (!report.paused) wanted = wanted.scaled(output.start_up.next(wanted.force_n.norm()));
    wanted = output.energy.allow(force::slewed(output.rendered, wanted, limits), stored_mj(model, load));
  }
  output.rendered = wanted;
  report.hand_force_n = wanted.force_n;
  report.hand_torque_n_mm = wanted.torque_n_mm;
}

}  // namespace ream::sim
