#pragma once
#include <limits>
#include <vector>

#include "case/case.hpp"

namespace ream::score {

/// Depth of a ray that meets nothing.
inline constexpr double no_surface_mm = std::numeric_limits<double>::infinity();

/// Parallel rays along the planned axis on a square lattice about it, within a disc. Depth is measured from
/// the plane through the entry, into the bone positive. Directions are chosen so that the lattice of a
/// mirrored case is the mirror image: `up` is the world's z as far as it lies across the axis, `across` is
/// anterior of a right shoulder's or a left one's lateral axis alike.
class RayLattice {
 public:
  RayLattice() = default;
  /// `along`: unit, into the bone. World frame.
  RayLattice(const Vec3& origin_mm, const Vec3& along, case_::Side side, double reach_mm, double spacing_mm);

  size_t size() const { return x_mm_.size(); }
  double x_mm(size_t ray) const { return x_mm_[ray]; }
  double y_mm(size_t ray) const { return y_mm_[ray]; }
  /// Point of a ray at a depth, world frame.
  Vec3 world(size_t ray, double depth_mm) const { return world(Vec3(x_mm_[ray], y_mm_[ray], depth_mm)); }
  /// World point of (across, up, depth), and back.
  Vec3 world(const Vec3& in_lattice_mm) const;
  Vec3 in_lattice(const Vec3& world_mm) const;
  /// The same of directions.
  Vec3 world_direction(const Vec3& in_lattice) const;
  Vec3 lattice_direction(const Vec3& world) const;

  double spacing_mm() const { return spacing_mm_; }
  double reach_mm() const { return reach_mm_; }
  double cell_area_mm2() const { return spacing_mm_ * spacing_mm_; }
  /// The ray beside one, `columns` and `rows` away; -1 beyond the disc.
  int neighbour(size_t ray, int columns, int rows) const;
  /// The ray nearest to a place across the axis; -1 beyond the disc.
  int nearest(double x_mm, double y_mm) const;
  /// Value at a place between rays, bilinear; no_surface_mm where one of the four has none.
  double between(const std::vector<double>& values, double x_mm, double y_mm) const;
  /// Mean of the values of each ray's neighbours within `radius_mm` (itself too) that differ by no more than
  /// `steepest` times their distance; no_surface_mm stays what it is.
  std::vector<double> smoothed(const std::vector<double>& values, double radius_mm, double steepest) const;
  /// Every `stride`-th ray of every `stride`-th row: their numbers here, in the order of the result.
  RayLattice thinned(int stride, std::vector<size_t>& kept) const;

 private:
  int at(int column, int row) const;

  Vec3 origin_mm_ = Vec3::Zero(), along_ = Vec3::UnitZ(), across_ = Vec3::UnitX(), up_ = Vec3::UnitY();
  double reach_mm_ = 0.0, spacing_mm_ = 1.0;
  int half_ = 0;             ///< columns and rows go from -half_ to half_
  std::vector<int> ray_at_;  ///< of column and row; -1 outside the disc
  std::vector<int> column_, row_;
  std::vector<double> x_mm_, y_mm_;
};

}  // namespace ream::score
