#pragma once
#include "voxelizer/tile_plan.hpp"

namespace ream::voxelizer {

/// Marks the voxels of a tile that the triangles of a mesh meet, a row's
/// voxels as whole words.
struct SurfaceMarker {
  const TriangleMesh& mesh;
  const VoxelMap& map;
  const TileBins& bins;
  Separability separability;

  void mark(size_t tile_number, int dims_x, const TileRows& tile) const;
};

}  // namespace ream::voxelizer
