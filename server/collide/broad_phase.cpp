#include "collide/broad_phase.hpp"

#include "collide/obb_sat.hpp"

namespace ream::collide {

Voi broad_phase(const Aabb& bone_box_grid, const Aabb& tool_box_tool, const Pose& grid_from_tool,
                double reach_mm) noexcept {
  Voi voi;
  if (bone_box_grid.empty() || tool_box_tool.empty()) return voi;
  const Aabb tool_box = tool_box_tool.grown(reach_mm);
  if (!overlap(Obb::from(bone_box_grid, Pose{}), Obb::from(tool_box, grid_from_tool))) return voi;
  const Aabb bone_in_tool = bone_box_grid.grown(reach_mm).transformed(grid_from_tool.inverse());
  voi.box_tool_mm = tool_box.intersection(bone_in_tool);
  voi.touching = !voi.box_tool_mm.empty();
  return voi;
}

}  // namespace ream::collide
