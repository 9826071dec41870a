#pragma once
#include <array>

#include "geometry/triangle_mesh.hpp"

namespace ream::voxelizer {

/// Voxels along one side, and altogether, beyond which a request is refused as a mistake.
inline constexpr int max_voxels_a_side = 1 << 20;
inline constexpr double max_voxels = 1099511627776.0;  // 2^40
/// How far a mesh may reach from a grid that was given, in voxels: beyond it doubles grow too coarse.
inline constexpr double max_corner_voxels = 16777216.0;  // 2^24

/// Which voxels a triangle marks: 26-separating is the supercover (thesis eqs 3.1-3.5), 6-separating the thin
/// form (eqs 3.6-3.8).
enum class Separability { six = 6, twenty_six = 26 };

/// Axis-aligned grid of any voxel size: voxel (u,v,w) fills (u,v,w) to (u+1,v+1,w+1) times `size_mm` from
/// `origin_mm`.
struct RasterGrid {
  Vec3i dims = Vec3i::Zero();
  Vec3 origin_mm = Vec3::Zero();  ///< minimum corner of voxel (0,0,0)
  Vec3 size_mm = Vec3::Ones();

  double voxels() const {
    return static_cast<double>(dims.x()) * static_cast<double>(dims.y()) * static_cast<double>(dims.z());
  }
  /// One bit a voxel, 32 voxels a word, u fastest, lowest bit first; each row of u begins a word.
  size_t words_per_row() const { return (static_cast<size_t>(dims.x()) + 31) / 32; }
  size_t rows() const { return static_cast<size_t>(dims.y()) * static_cast<size_t>(dims.z()); }
  Vec3 centre_mm(int u, int v, int w) const {
    return origin_mm + (Vec3(u + 0.5, v + 0.5, w + 0.5).array() * size_mm.array()).matrix();
  }
};

/// Half-open range of rows (v,w) of a grid that is worked on at once.
struct RowRange {
  int v_begin = 0, v_end = 0, w_begin = 0, w_end = 0;

  size_t rows() const { return static_cast<size_t>(v_end - v_begin) * static_cast<size_t>(w_end - w_begin); }
};

/// From a mesh's own coordinates to voxels of a grid: coordinate * factor + offset, axis by axis.
struct VoxelMap {
  std::array<double, 3> factor{}, offset{};
};

/// `scale`: mm of the grid for one unit of the mesh's coordinates.
VoxelMap voxel_map(const RasterGrid& grid, double scale);

/// Box of what the triangles use, in mm. Throws Error invalid_input for a mesh without triangles, an index
/// out of range, coordinates that are not finite or a scale that is not positive.
Aabb used_bounds(const TriangleMesh& mesh, double scale);

/// Grid around a box, grown by half a voxel on each side so that no surface lies on the border. Throws Error
/// invalid_input for a size that is not positive or more than `max_voxels`.
RasterGrid grid_around(const Aabb& box_mm, const Vec3& size_mm);

/// Grid around a box whose voxels have a corner at `corner_mm`, wherever that is. Errors as grid_around.
RasterGrid grid_from(const Vec3& corner_mm, const Aabb& box_mm, const Vec3& size_mm);

/// Throws Error invalid_input naming what is wrong with the grid: no voxels, too many, sizes that are not
/// positive.
void check_grid(const RasterGrid& grid);

/// Throws Error invalid_input when the box reaches farther than `max_corner_voxels` voxels from the grid.
void check_reach(const RasterGrid& grid, const Aabb& box_mm);

}  // namespace ream::voxelizer
