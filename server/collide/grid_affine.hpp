#pragma once
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

}  // namespace ream::collide
