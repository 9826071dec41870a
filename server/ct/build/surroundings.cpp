#include "ct/build/surroundings.hpp"

#include <algorithm>

namespace ream::ct {

TriangleMesh surroundings_of(const TriangleMesh& bone_world, const voxel::VoxelGrid& grid) {
  const Pose grid_from_world = grid.world_from_grid.inverse();
  // The grid's own surface is closed along its sides.
  const Vec3 low = 0.5 * grid.spacing_mm, high = grid.bounds_mm().max - low;
  std::vector<uint8_t> inside(bone_world.vertices_mm.size());
  for (size_t i = 0; i < inside.size(); ++i) {
    const Vec3 at = grid_from_world.point(bone_world.vertices_mm[i].cast<double>());
    inside[i] = (at.array() >= low.array()).all() && (at.array() <= high.array()).all();
  }
  constexpr uint32_t unused = UINT32_MAX;
  std::vector<uint32_t> place(inside.size(), unused);
  TriangleMesh around;
  for (std::array<uint32_t, 3> triangle : bone_world.triangles) {
    if (std::all_of(triangle.begin(), triangle.end(), [&](uint32_t corner) { return inside[corner]; }))
      continue;
    for (uint32_t& corner : triangle) {
      if (place[corner] == unused) {
        place[corner] = static_cast<uint32_t>(around.vertices_mm.size());
        around.vertices_mm.push_back(bone_world.vertices_mm[corner]);
        if (!bone_world.normals.empty()) around.normals.push_back(bone_world.normals[corner]);
      }
      corner = place[corner];
    }
    around.triangles.push_back(triangle);
  }
  return around;
}

}  // namespace ream::ct
