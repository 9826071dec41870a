#pragma once
#include <array>
#include <cstdint>

#include "geometry/box.hpp"
#include "geometry/pose.hpp"
#include "voxel/voxel_grid.hpp"

namespace ream::collide {

/// Affine map in floats, row by row: out_i = m[3i] x + m[3i+1] y + m[3i+2] z + t[i]. Derived from the
/// quantised pose on the host once a tick, in doubles rounded to float, so that every device sees the same
/// twelve numbers.
struct GridAffine {
  float m[9];
  float t[3];
};

/// Tool frame (mm) to continuous voxel coordinates; voxel (u,v,w) holds [u, u+1) x [v, v+1) x [w, w+1).
GridAffine voxel_from_tool(const QuantisedPose& grid_from_tool, const voxel::VoxelGrid& grid) noexcept;

/// Voxel index (its centre) to the tool frame, mm.
GridAffine tool_from_voxel(const QuantisedPose& grid_from_tool, const voxel::VoxelGrid& grid) noexcept;

/// Takes the contact shell's places to voxels in whole numbers only, so that every device and compiler agrees
/// to the bit. A voxel coordinate is held in 2^-bits voxel; its voxel is that number shifted right by `bits`.
struct VoxelTransform {
  int bits = 0;
  std::array<int32_t, 9> per_unit{};  ///< row by row, each within 16 bits
  /// Takes normals of the tool frame to the grid's axes, times the voxel's edge along each in smallest edges;
  /// row by row in 1/128 (collide/contact/surface_judge.hpp).
  std::array<int32_t, 9> normal_rotation{};
  /// The same and the tool's origin in 2^-40 voxel, for the blocks' origins.
  std::array<int64_t, 9> fine{};
  std::array<int64_t, 3> origin_fine{};

  /// Coordinates of a block's origin in 2^-bits voxel. They fit 32 bits for blocks within 64 voxels of the
  /// grid.
  std::array<int32_t, 3> base(const Vec3i& origin_units) const noexcept;
};

/// Derived from the quantised pose in doubles, each number rounded once. `place_unit_mm` is the shell's.
VoxelTransform voxel_transform(const QuantisedPose& grid_from_tool, const voxel::VoxelGrid& grid,
                               double place_unit_mm) noexcept;

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
