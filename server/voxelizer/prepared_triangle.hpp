#pragma once
#include <cstdint>

#include "voxelizer/raster_grid.hpp"

namespace ream::voxelizer {

/// Which voxels a triangle marks: 26-separating is the supercover (thesis eqs 3.1-3.5), 6-separating the thin
/// form (eqs 3.6-3.8).
enum class Separability { six = 6, twenty_six = 26 };

/// Corners are rounded to 2^-20 voxel, so that differences of corners are exact; boxes are grown by `margin`
/// voxels on each side, more than what that moves a corner and what the tests round. A triangle therefore
/// marks every voxel that it touches and none farther from it than 2^-19 voxel.
inline constexpr double margin = 9.5367431640625e-07;  // 2^-20

/// Half-open range of rows (v,w) of a grid that is worked on at once.
struct RowRange {
  int v_begin = 0, v_end = 0, w_begin = 0, w_end = 0;
};

/// Bounds of voxel index x along a row or column of index s: x at least lower + lower_slope * s for each of
/// three edges, and at most upper + upper_slope * s. Edges that bound one side only have no bound (1e30) on
/// the other.
struct EdgeBounds {
  double lower[3], lower_slope[3], upper[3], upper_slope[3];
};

/// Corners of a triangle in voxels of the grid, and the voxels that its box touches within some rows.
struct PlacedTriangle {
  double corner[3][3];  ///< [corner][axis]
  int low[3], high[3];  ///< inclusive

  /// False when the box touches none of these rows; it may still lie beside the grid in x, where low[0] >
  /// high[0].
  bool place(const TriangleMesh& mesh, size_t triangle, const VoxelMap& map, int dims_x,
             const RowRange& rows);
};

/// Everything that the separating-axis test of thesis section 3.4 asks of a row of voxels, solved for u: the
/// voxels of a row that a triangle marks are the whole numbers between the largest lower and the smallest
/// upper bound.
struct PreparedTriangle {
  EdgeBounds u_by_v, u_by_w, v_by_w;
  /// Eqs 3.2, 3.6, 3.7: u within plane_width of plane + plane_by_v * v + plane_by_w * w (Schwarz and Seidel's
  /// bound of a column by the plane equation).
  double plane, plane_by_v, plane_by_w, plane_width;

  void prepare(const PlacedTriangle& t, bool thin);
  /// The plane alone.
  void prepare_plane(const PlacedTriangle& t);

 private:
  void set_edges(const PlacedTriangle& t, const double normal[3], bool thin);
  void set_plane(const PlacedTriangle& t, const double normal[3], bool thin);
};

/// a*b - c*d as if rounded once, for values whose products do not overflow: Dekker's exact products.
double difference_of_products(double a, double b, double c, double d);

/// Not normalised; each component is exact to one rounding.
void exact_normal(const PlacedTriangle& t, double normal[3]);

}  // namespace ream::voxelizer
