#include "voxel/voxel_grid.hpp"

#include <cmath>
#include <string>

#include "core/error.hpp"

namespace ream::voxel {

Vec3i VoxelGrid::coordinates(size_t index) const {
  const auto inside = static_cast<int>(index % brick_voxels);
  const Vec3i first = brick_coordinates(static_cast<uint32_t>(index / brick_voxels)) * brick_edge;
  return first +
         Vec3i(inside % brick_edge, inside / brick_edge % brick_edge, inside / (brick_edge * brick_edge));
}

Vec3i VoxelGrid::voxel_at(const Vec3& point_mm) const {
  return {static_cast<int>(std::floor(point_mm.x() / spacing_mm.x())),
          static_cast<int>(std::floor(point_mm.y() / spacing_mm.y())),
          static_cast<int>(std::floor(point_mm.z() / spacing_mm.z()))};
}

Vec3i VoxelGrid::brick_coordinates(uint32_t brick) const {
  const Vec3i b = brick_dims();
  const int i = static_cast<int>(brick);
  return {i % b.x(), (i / b.x()) % b.y(), i / (b.x() * b.y())};
}

Vec3i whole_bricks(const Vec3i& dims) {
  return (dims.array() + (brick_edge - 1)).matrix() / brick_edge * brick_edge;
}

void validate(const VoxelGrid& grid) {
  const auto text = [](const auto& v) {
    return std::to_string(v.x()) + " x " + std::to_string(v.y()) + " x " + std::to_string(v.z());
  };
  if ((grid.dims.array() <= 0).any())
    throw Error(ErrorKind::invalid_input,
                "the grid is " + text(grid.dims) + " voxels; every side must be positive");
  if (grid.dims != whole_bricks(grid.dims))
    throw Error(ErrorKind::invalid_input,
                "the grid is " + text(grid.dims) + " voxels; sides must be multiples of 8");
  if (grid.dims.cast<double>().prod() > 2147483647.0)
    throw Error(ErrorKind::invalid_input,
                "the grid is " + text(grid.dims) + " voxels, more than 2^31; take a smaller region");
  if (!grid.spacing_mm.allFinite() || (grid.spacing_mm.array() <= 0.0).any())
    throw Error(ErrorKind::invalid_input,
                "the voxel size is " + text(grid.spacing_mm) + " mm; it must be positive and finite");
}

}  // namespace ream::voxel
