#include "collide/odometer.hpp"

#include <algorithm>
#include <cmath>

namespace ream::collide {
namespace {

/// Upper bound of the length of v without a square root: exact along axes and diagonals, at most 8 % over.
double length_bound(const Vec3& v) {
  double a = std::abs(v.x()), b = std::abs(v.y()), c = std::abs(v.z());
  if (a < b) std::swap(a, b);
  if (b < c) std::swap(b, c);
  if (a < b) std::swap(a, b);
  return a + 0.4142135624 * b + 0.3178372452 * c;
}

}  // namespace

double Odometer::advance(const Pose& grid_from_tool) noexcept {
  double moved_mm = 0.0;
  // A point's way between two poses is linear in its place, so a corner of the box goes farthest.
  for (int i = 0; started_ && i < 8; ++i) {
    const Vec3 corner(i & 1 ? box_.max.x() : box_.min.x(), i & 2 ? box_.max.y() : box_.min.y(),
                      i & 4 ? box_.max.z() : box_.min.z());
    moved_mm = std::max(moved_mm, length_bound(grid_from_tool.point(corner) - previous_.point(corner)));
  }
  started_ = true;
  previous_ = grid_from_tool;
  voxels_ = voxels_ + moved_mm / voxel_mm_;
  return voxels_;
}

}  // namespace ream::collide
