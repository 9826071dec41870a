#include "shell/surface_voxelizer.hpp"

#include <bit>
#include <cmath>
#include <sstream>

#include "core/error.hpp"
#include "shell/surface_corners.hpp"

namespace ream::shell {
namespace {

/// Cells along one side, and bytes of bits altogether, beyond which a request is a mistake rather than a
/// wish.
constexpr double most_cells_a_side = 1 << 20;
constexpr double most_bytes = 16.0 * 1024 * 1024 * 1024;

}  // namespace

size_t SurfaceVoxels::filled_cells() const {
  size_t count = 0;
  for (const uint32_t word : words) count += static_cast<size_t>(std::popcount(word));
  return count;
}

SurfaceVoxels surface_grid(const TriangleMesh& mesh, double size_mm) {
  if (!std::isfinite(size_mm) || size_mm <= 0.0) {
    std::ostringstream text;
    text << "the voxel size is " << size_mm << " mm; it must be positive";
    throw Error(ErrorKind::invalid_input, text.str());
  }
  if (mesh.triangles.empty()) throw Error(ErrorKind::invalid_input, "the mesh has no triangles to voxelize");
  const Aabb box = mesh.bounds();
  if (box.empty() || !box.min.allFinite() || !box.max.allFinite())
    throw Error(ErrorKind::invalid_input, "the mesh has vertices that are not finite");

  // Half a cell before, half a cell and rounding behind: the box's far side lies in the middle of the last
  // cell or before.
  constexpr double rounding_cells = 1e-6;
  const Vec3 cells = ((box.max - box.min) / size_mm).array() + (1.0 - rounding_cells);
  const double bytes = cells.x() / 8.0 * cells.y() * cells.z();
  if (!(cells.maxCoeff() < most_cells_a_side) || !(bytes < most_bytes)) {
    std::ostringstream text;
    text << "voxels of " << size_mm << " mm would make a grid of " << std::ceil(cells.x()) << " x "
         << std::ceil(cells.y()) << " x " << std::ceil(cells.z()) << " cells; use larger voxels";
    throw Error(ErrorKind::invalid_input, text.str());
  }
  SurfaceVoxels grid;
  grid.size_mm = size_mm;
  grid.origin_mm = box.min.array() - 0.5 * size_mm;
  grid.dims = cells.array().ceil().max(1.0).cast<int>();
  grid.words.assign(grid.word_index(0, 0, grid.dims.z()), 0);
  return grid;
}

std::vector<float> surface_corners(const TriangleMesh& mesh, const SurfaceVoxels& grid) {
  std::vector<float> corners;
  corners.reserve(mesh.triangles.size() * 9);
  for (const auto& triangle : mesh.triangles)
    for (const uint32_t vertex : triangle) {
      const Vec3 cells = (mesh.vertices_mm[vertex].cast<double>() - grid.origin_mm) / grid.size_mm;
      for (int k = 0; k < 3; ++k) corners.push_back(static_cast<float>(cells[k]));
    }
  return corners;
}

}  // namespace ream::shell
