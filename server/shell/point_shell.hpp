#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "shell/surface_voxelizer.hpp"
#include "shell/tool.hpp"

namespace ream::shell {

/// Area weights are whole numbers of this part of a cell face.
inline constexpr int area_weights_a_face = 16;

/// One point of the shell that feels bone, tool frame.
struct ShellPoint {
  uint64_t morton = 0;  ///< cell of the shell's grid
  Vec3f normal =
      Vec3f::UnitZ();  ///< outward, unit; it meets the axis, as the envelope is a surface of revolution
  float surface_offset_mm = 0;  ///< signed step along the normal from the cell centre to the true surface
  uint8_t area_weight = area_weights_a_face;  ///< area: 16 / max|n_i| for the thin voxelization
  SurfaceRole role = SurfaceRole::cutting;
};

/// Points of one block of 8^3 cells, consecutive in `points`.
struct ShellBlock {
  uint32_t first = 0, count = 0;
  Vec3f centre_mm = Vec3f::Zero();  ///< bounding sphere of the points' true surface positions, tool frame
  float radius_mm = 0;
};

/// The tool's envelope (revolved profile) as points: centroids of its 6-separable voxelization (thesis 4.3),
/// sorted by Morton code, so that blocks of 8^3 cells are runs. At most 2048 cells a side. Smooth segments
/// (the back) give no points when `with_smooth` is false.
struct PointShell {
  double spacing_mm = 0;
  Vec3 origin_mm = Vec3::Zero();  ///< minimum corner of cell (0,0,0), tool frame
  Vec3i dims = Vec3i::Zero();
  std::vector<ShellPoint> points;
  std::vector<ShellBlock> blocks;

  Vec3 cell_centre_mm(uint64_t morton) const;
  /// Where the point lies on the true surface: cell centre + offset along the normal.
  Vec3 surface_point_mm(const ShellPoint& p) const;
  Aabb bounds_mm() const;
};

/// Throws Error invalid_input when the spacing makes more than 2048 cells a side or no points.
PointShell make_point_shell(const Tool& tool, double spacing_mm, bool with_smooth = true);

}  // namespace ream::shell
