#include "score/placements.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "score/alignment.hpp"
#include "shell/parametric_profile.hpp"

namespace ream::score {

Placements placements_of(const NativeGlenoid& native, const CoverageView& left,
                         const std::optional<CutLine>& plan_line, const Pose& world_from_plan) {
  const RayLattice& rays = native.rays();
  const auto in_world = [&](const Vec3& apex_mm, const Vec3& axis) {
    return Placement{rays.world(apex_mm), rays.world_direction(axis)};
  };
  Placements placements;
  const auto& plan = native.task().plan;
  if (const auto contact = first_contact_mm(native); contact && plan)
    placements.planned = in_world(Vec3(0.0, 0.0, *contact + plan->depth_mm), Vec3::UnitZ());
  if (!plan_line) return placements;
  const CutLine line = in_lattice(rays, *plan_line, world_from_plan);
  placements.achieved = in_world(line.deepest_apex_mm(), line.direction);
  const Component component(native, achieved_face(native, left), line);
  if (component.seated()) placements.implant = in_world(component.apex_mm(), component.axis());
  return placements;
}

SweptFront implant_back(const Task& task, double thickness_mm) {
  if (!task.plan || !task.plan->implant_radius_mm) return {task.reamer, thickness_mm};
  const double radius_mm = *task.plan->implant_radius_mm;
  const double outer_mm = std::min(radius_mm, CuttingMeridian(task.reamer).outer_mm());
  const std::string words =
      "sphere " + nlohmann::json(radius_mm).dump() + "," + nlohmann::json(outer_mm).dump();
  return {shell::parametric_profile(words), thickness_mm};
}

}  // namespace ream::score
