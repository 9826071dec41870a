#pragma once
#include "geometry/box.hpp"

namespace ream::collide {

/// How far the tool has moved at most: an upper bound of the path of any point of a box, in voxels.
class Odometer {
 public:
  /// `box_tool_mm` holds every point that matters; one voxel is `voxel_mm`.
  Odometer(const Aabb& box_tool_mm, double voxel_mm) : box_(box_tool_mm), voxel_mm_(voxel_mm) {}

  /// Adds the way from the pose before, none for the first, and returns the reading.
  double advance(const Pose& grid_from_tool) noexcept;
  double voxels() const noexcept { return voxels_; }
  /// Takes `voxels` off the reading, for those who keep readings in few bits.
  void rebase(double voxels) noexcept { voxels_ -= voxels; }

 private:
  Aabb box_;
  double voxel_mm_;
  Pose previous_;
  bool started_ = false;
  double voxels_ = 0.0;
};

}  // namespace ream::collide
