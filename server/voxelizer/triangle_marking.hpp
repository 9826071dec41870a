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
