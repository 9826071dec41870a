#pragma once
#include <algorithm>
#include <cmath>

#include "case/case.hpp"
#include "voxel/bone_model.hpp"

namespace ream::test {

/// A block of bone that fills the grid below the plane z = surface_mm (grid frame), of one density, with
/// sub-voxel coverage at the plane.
inline voxel::BoneModel slab(const Vec3i& dims, double spacing_mm, double surface_mm, double density_g_cc) {
  voxel::VoxelGrid grid;
  grid.dims = dims;
  grid.spacing_mm = Vec3::Constant(spacing_mm);
  voxel::BoneModel bone = voxel::make_bone(grid);
  std::fill(bone.density.writable().begin(), bone.density.writable().end(),
            voxel::density_code(density_g_cc));
  for (int w = 0; w < dims.z(); ++w) {
    const double inside = (surface_mm - (w + 0.5) * spacing_mm) / spacing_mm;
    const double level = std::clamp(128.0 + 255.0 * inside, 0.0, 255.0);
    for (int v = 0; v < dims.y(); ++v)
      for (int u = 0; u < dims.x(); ++u) bone.coverage[grid.index(u, v, w)] = static_cast<uint8_t>(level);
  }
  return bone;
}

/// Plan that reams straight down into a slab at its middle.
inline case_::Plan slab_plan(const voxel::BoneModel& bone, double surface_mm) {
  case_::Plan plan;
  const Vec3 middle = bone.grid.bounds_mm().centre();
  plan.entry_mm = bone.grid.world_from_grid.point(Vec3(middle.x(), middle.y(), surface_mm));
  plan.axis_direction = bone.grid.world_from_grid.direction(-Vec3::UnitZ());
  plan.pilot_hole.reset();
  return plan;
}

}  // namespace ream::test
