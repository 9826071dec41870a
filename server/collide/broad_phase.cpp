#include "collide/broad_phase.hpp"

#include <algorithm>

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

Aabb bone_bounds_mm(const voxel::BoneModel& bone) {
  const auto& grid = bone.grid;
  Vec3i low = grid.dims, high = Vec3i::Constant(-1);
  for (size_t i = 0; i < bone.coverage.size(); ++i) {
    if (bone.coverage[i] == 0) continue;
    const Vec3i at = grid.coordinates(i);
    low = low.cwiseMin(at);
    high = high.cwiseMax(at);
  }
  Aabb box;
  if ((high.array() < 0).any()) return box;
  box.include((low.cast<double>().array() * grid.spacing_mm.array()).matrix());
  box.include(((high.cast<double>().array() + 1.0) * grid.spacing_mm.array()).matrix());
  return box;
}

}  // namespace ream::collide
