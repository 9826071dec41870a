#pragma once
#include "voxelizer/tile_plan.hpp"

namespace ream::voxelizer {

/// Where a triangle's edges pass the lines of voxel centres along x: what the parity of a solid is made of.
/// An edge is written from its lower to its upper end in z, so that both triangles that share it get the same
/// numbers and no line slips between them or counts twice.
struct FlipEdges {
  double lower[3], upper[3];  ///< z from which and below which a line passes the edge; none: lower == upper
  double y[3], y_by_z[3];     ///< y = y + y_by_z * z on it
};

FlipEdges flip_edges(const PlacedTriangle& t);

/// Flips, in every row whose line of centres passes the triangle, the first voxel whose centre lies behind
/// it.
void flip_triangle(const PlacedTriangle& placed, const PreparedTriangle& prepared, int dims_x,
                   const TileRows& tile);

/// Turns flips into voxels: the voxel and all behind it up to the next flip. Bits beyond dims_x become 0.
void fill_between_flips(uint32_t* row, int dims_x);

/// Flips and fills of some triangles of a mesh in a tile that is all 0.
struct SolidFiller {
  const TriangleMesh& mesh;
  const VoxelMap& map;
  const TileBins& bins;

  void fill(size_t tile_number, int dims_x, const TileRows& tile) const;
};

}  // namespace ream::voxelizer
