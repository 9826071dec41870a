#pragma once
#include "voxelizer/tile_plan.hpp"

namespace ream::voxelizer {

/// Marks the voxels of a tile that a triangle meets. Rows are taken eight at a time, a row's voxels as whole
/// words.
void mark_triangle(const PlacedTriangle& placed, const PreparedTriangle& prepared, const TileRows& tile);

/// Marks what some triangles of a mesh mark in a tile.
struct SurfaceMarker {
  const TriangleMesh& mesh;
  const VoxelMap& map;
  const TileBins& bins;
  Separability separability;

  void mark(size_t tile_number, int dims_x, const TileRows& tile) const;
};

}  // namespace ream::voxelizer
