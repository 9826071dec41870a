#include "sim/scapula_mount.hpp"

#include <Eigen/Geometry>

#include "core/clock.hpp"
#include "sim/approach.hpp"
#include "sim/state.hpp"

namespace ream::sim {
namespace {

/// Share of the spring's deflection that the bone may take up in one tick.
constexpr double max_gain = 0.5;

/// x after a tick of damping x' + stiffness x = load.
Vec3 settled(const Vec3& stiffness, const Vec3& damping, const Vec3& x, const Vec3& load, double tick_s) {
  return ((damping.array() * x.array() + tick_s * load.array()) /
          (damping.array() + tick_s * stiffness.array()))
      .matrix();
}

}  // namespace

std::optional<device::ScapulaMount> stable_mount(const Model& model) {
  if (!model.settings.mount) return std::nullopt;
  device::ScapulaMount mount = *model.settings.mount;
  const double lever_mm = model.contact_shell.moment_length_mm;
  const double linear = model.coupling.stiffness_n_mm * model.coupling.force_scale;
  const double angular =
      model.coupling.angular_stiffness_n_mm_rad * model.coupling.force_scale + lever_mm * lever_mm * linear;
  const double min_linear = linear * tick_s / max_gain, min_angular = angular * tick_s / max_gain;
  mount.damping_n_s_mm = mount.damping_n_s_mm.cwiseMax(min_linear);
  mount.angular_damping_n_mm_s_rad = mount.angular_damping_n_mm_s_rad.cwiseMax(min_angular);
  return mount;
}

MountState settled_mount(const device::ScapulaMount& mount, const MountState& state,
                         const force::Wrench& about_entry, double step_s) noexcept {
  return {settled(mount.stiffness_n_mm, mount.damping_n_s_mm, state.shift_mm, about_entry.force_n, step_s),
          settled(mount.angular_stiffness_n_mm_rad, mount.angular_damping_n_mm_s_rad, state.turn_rad,
                  about_entry.torque_n_mm, step_s)};
}

Pose displacement(const MountState& state, const Vec3& point_mm) noexcept {
  const Mat3 turn = rotation_from_small_vector(state.turn_rad);
  return {turn, point_mm + state.shift_mm - turn * point_mm};
}

void move_bone(const Model& model, State& state, const ToolLoad& load, bool carried) noexcept {
  if (!model.mount) return;
  const Vec3 rest_mm = model.plan.entry_mm;
  const Vec3 arm_mm = state.world_from_tool.translation_mm - (rest_mm + state.mount.shift_mm);
  const Mat3& world_from_tool = state.world_from_tool.rotation;
  const Vec3 force_n = world_from_tool * load.spring.force_n;
  const Vec3 torque_n_mm =
      world_from_tool *
      (load.spring.torque_n_mm + (carried ? state.spindle.bone_torque_n_mm() : 0.0) * Vec3::UnitZ());
  const force::Wrench about_entry{force_n, torque_n_mm + arm_mm.cross(force_n)};
  const MountState target = settled_mount(*model.mount, state.mount, about_entry, tick_s);
  const Pose before = state.world_from_bone_rest;
  const auto settle = [&](double fraction) {
    MountState settled;
    settled.shift_mm = state.mount.shift_mm + fraction * (target.shift_mm - state.mount.shift_mm);
    settled.turn_rad = state.mount.turn_rad + fraction * (target.turn_rad - state.mount.turn_rad);
    return settled;
  };
  const Pose there = displacement(target, rest_mm);
  // A bone that springs back comes no farther in a tick than a tool may move without looking for contact.
  const double limit_mm = look_every_voxels * model.thin_step_mm;
  const double path_mm = carried ? 0.0
                                 : path_bound_mm(model, before.inverse() * state.world_from_tool,
                                                 there.inverse() * state.world_from_tool);
  state.mount = path_mm > limit_mm ? settle(limit_mm / path_mm) : target;
  state.world_from_bone_rest = displacement(state.mount, rest_mm);
  state.world_from_grid = state.world_from_bone_rest * state.bone.grid.world_from_grid;
  state.free_path_mm = -1.0;
  if (!carried) return;
  state.world_from_tool = state.world_from_bone_rest * before.inverse() * state.world_from_tool;
  state.world_from_tool.rotation = orthonormalized(state.world_from_tool.rotation);
}

}  // namespace ream::sim
