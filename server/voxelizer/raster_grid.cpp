#include "voxelizer/raster_grid.hpp"

#include <cmath>
#include <sstream>

#include "core/error.hpp"

namespace ream::voxelizer {
namespace {

[[noreturn]] void refuse(const std::string& why) { throw Error(ErrorKind::invalid_input, why); }

std::string text_of(const Vec3& v) {
  std::ostringstream text;
  text << v.x() << " x " << v.y() << " x " << v.z();
  return text.str();
}

void check_count(const Vec3& voxels, const Vec3& size_mm) {
  const double count = voxels.x() * voxels.y() * voxels.z();
  if (voxels.allFinite() && voxels.maxCoeff() <= max_voxels_a_side && count <= max_voxels) return;
  refuse("voxels of " + text_of(size_mm) + " mm would make a grid of " + text_of(voxels) +
         " voxels, more than 2^40 or 2^20 along a side; use larger voxels");
}

void check_size(const Vec3& size_mm) {
  if (!size_mm.allFinite() || !(size_mm.minCoeff() > 0.0))
    refuse("the voxel size is " + text_of(size_mm) + " mm; it must be positive");
}

}  // namespace

VoxelMap voxel_map(const RasterGrid& grid, double scale) {
  VoxelMap map;
  for (size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    map.factor[k] = scale / grid.size_mm[axis];
    map.offset[k] = -grid.origin_mm[axis] / grid.size_mm[axis];
  }
  return map;
}

Aabb used_bounds(const TriangleMesh& mesh, double scale) {
  if (!std::isfinite(scale) || !(scale > 0.0)) {
    std::ostringstream text;
    text << "the scale is " << scale << "; it must be positive";
    refuse(text.str());
  }
  if (mesh.triangles.empty()) refuse("the mesh has no triangles to voxelize");
  Aabb box;
  for (size_t i = 0; i < mesh.triangles.size(); ++i)
    for (const uint32_t vertex : mesh.triangles[i]) {
      if (vertex >= mesh.vertices_mm.size())
        refuse("triangle " + std::to_string(i) + " names vertex " + std::to_string(vertex) + " of " +
               std::to_string(mesh.vertices_mm.size()));
      const Vec3 corner = scale * mesh.vertices_mm[vertex].cast<double>();
      if (!corner.allFinite()) refuse("vertex " + std::to_string(vertex) + " is not a finite number");
      box.include(corner);
    }
  return box;
}

RasterGrid grid_around(const Aabb& box_mm, const Vec3& size_mm) {
  check_size(size_mm);
  // Half a voxel before, half a voxel and rounding behind: the box's far side lies in the middle of the last
  // voxel or before.
  constexpr double rounding_voxels = 1e-6;
  const Vec3 voxels =
      (((box_mm.max - box_mm.min).array() / size_mm.array()) + (1.0 - rounding_voxels)).ceil().max(1.0);
  check_count(voxels, size_mm);
  RasterGrid grid;
  grid.size_mm = size_mm;
  grid.origin_mm = box_mm.min - 0.5 * size_mm;
  grid.dims = voxels.cast<int>();
  return grid;
}

RasterGrid grid_from(const Vec3& corner_mm, const Aabb& box_mm, const Vec3& size_mm) {
  check_size(size_mm);
  // A voxel's breadth beyond what the box touches on either side.
  const Vec3 low = ((box_mm.min - corner_mm).array() / size_mm.array() - 1.0).floor();
  const Vec3 high = ((box_mm.max - corner_mm).array() / size_mm.array() + 1.0).ceil();
  check_count(high - low, size_mm);
  RasterGrid grid;
  grid.size_mm = size_mm;
  grid.origin_mm = corner_mm + (low.array() * size_mm.array()).matrix();
  grid.dims = (high - low).cast<int>();
  return grid;
}

void check_grid(const RasterGrid& grid) {
  check_size(grid.size_mm);
  if (!grid.origin_mm.allFinite()) refuse("the grid's origin is not a finite number");
  if (grid.dims.minCoeff() < 1) refuse("a grid of " + text_of(grid.dims.cast<double>()) + " voxels is empty");
  check_count(grid.dims.cast<double>(), grid.size_mm);
}

void check_reach(const RasterGrid& grid, const Aabb& box_mm) {
  const Vec3 low = ((box_mm.min - grid.origin_mm).array() / grid.size_mm.array()).matrix();
  const Vec3 high = ((box_mm.max - grid.origin_mm).array() / grid.size_mm.array()).matrix();
  if (low.minCoeff() < -max_corner_voxels || high.maxCoeff() > max_corner_voxels)
    refuse("the mesh reaches more than 2^24 voxels from the grid; use larger voxels or another grid");
}

}  // namespace ream::voxelizer
