#include "sim/guided_handle.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "sim/press.hpp"

namespace ream::sim {
namespace {

Pose world_from_guide(const Model& model, const State& state) {
  return state.world_from_bone_rest * model.world_from_plan;
}

force::Guide nipple_of(const shell::Tool& tool, const case_::PilotHole& hole) {
  const shell::ToolProfile& profile = tool.profile;
  double radius_mm = 0.0, height_mm = 0.0;
  for (size_t i = 0; i < profile.roles.size() && profile.roles[i] == shell::SurfaceRole::guiding; ++i)
    height_mm = std::max(height_mm, profile.points[i].z_mm);
  for (size_t i = 0; i < profile.roles.size() && profile.roles[i] == shell::SurfaceRole::guiding; ++i)
    radius_mm = std::max(radius_mm, profile.points[i].radius_mm);
  if (height_mm <= 0.0)
    throw Error(ErrorKind::conflict, "the plan's guide is the nipple, but reamer '" + tool.name +
                                         "' has none; choose one with a nipple, such as 'ellipse 18.25,9 "
                                         "nipple 3,8', or guide the reamer by a pin");
  return force::nipple_guide(radius_mm, height_mm, hole.diameter_mm, hole.depth_mm);
}

}  // namespace

std::optional<force::Guide> make_guide(const Model& model) {
  if (model.plan.guide == case_::GuideKind::none) return std::nullopt;
  force::Guide guide = force::pin_guide();
  if (model.plan.guide == case_::GuideKind::nipple) {
    if (!model.plan.pilot_hole)
      throw Error(ErrorKind::conflict,
                  "the plan's guide is the nipple, but it has no pilot hole; plan one, or another guide");
    guide = nipple_of(model.tool, *model.plan.pilot_hole);
  }
  guide.angular_per_linear_mm2 = model.coupling.angular_stiffness_n_mm_rad / model.coupling.stiffness_n_mm;
  return guide;
}

Pose guided(const Model& model, State& state, const Pose& world_from_handle) noexcept {
  if (!model.guide || !state.guide.entered) return world_from_handle;
  const Pose world_from_guide_now = world_from_guide(model, state);
  const Pose guide_from_handle = world_from_guide_now.inverse() * world_from_handle;
  const Pose allowed = force::constrained(*model.guide, state.guide, guide_from_handle);
  return allowed == guide_from_handle ? world_from_handle : world_from_guide_now * allowed;
}

void add_guide(const Model& model, const State& state, const Pose& world_from_handle,
               const Pose& world_from_guided, ToolLoad& load, TickReport& report) noexcept {
  if (!state.guide.entered) return;
  const double linear = model.coupling.stiffness_n_mm * model.coupling.force_scale;
  const double angular = model.coupling.angular_stiffness_n_mm_rad * model.coupling.force_scale;
  const force::Vec6 held_back = handle_minus_tool(world_from_guided, world_from_handle);
  const Mat3 tool_from_guided = state.world_from_tool.rotation.transpose() * world_from_guided.rotation;
  const Vec3 force_n = linear * (tool_from_guided * Vec3(held_back[0], held_back[1], held_back[2]));
  load.spring.force_n += force_n;
  load.spring.torque_n_mm += angular * (tool_from_guided * Vec3(held_back[3], held_back[4], held_back[5]));
  load.unlimited_force_n += force_n.norm() / model.coupling.force_scale;
  report.guide_force_n = force_n.norm();
}

void keep_in_guide(const Model& model, State& state) noexcept {
  if (!model.guide) return;
  const Pose world_from_guide_now = world_from_guide(model, state);
  const Pose guide_from_tool = world_from_guide_now.inverse() * state.world_from_tool;
  const Pose kept = force::held(*model.guide, state.guide, guide_from_tool);
  if (!(kept == guide_from_tool)) {
    state.world_from_tool = world_from_guide_now * kept;
    state.free_path_mm = -1.0;
  }
  force::follow(*model.guide, state.guide, kept);
}

}  // namespace ream::sim
