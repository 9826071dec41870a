#include "collide/odometer.hpp"

#include <algorithm>

namespace ream::collide {
double Odometer::advance(const Pose& grid_from_tool) noexcept {
  double moved_mm = 0.0;
  // A point's way between two poses is linear in its place, so a corner of the box goes farthest.
  for (int i = 0; started_ && i < 8; ++i) {
    const Vec3 corner = box_.corner(i);
    moved_mm = std::max(moved_mm, length_bound(grid_from_tool.point(corner) - previous_.point(corner)));
  }
  started_ = true;
  previous_ = grid_from_tool;
  voxels_ = voxels_ + moved_mm / voxel_mm_;
  return voxels_;
}

}  // namespace ream::collide
