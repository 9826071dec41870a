#pragma once
#include <unordered_map>

#include "geometry/triangle_mesh.hpp"
#include "stream/codec.hpp"
#include "voxel/voxel_grid.hpp"

namespace ream::openigtlink {

/// The newest surface of every block of one bone, as it comes from the stream. Used by one thread.
class BonePicture {
 public:
  explicit BonePicture(const voxel::VoxelGrid& grid) : grid_(grid) {}

  void take(stream::SharedBlock block);

  /// All of it as one mesh in RAS, mm, with normals; vertices that blocks share are one. Error invalid_input
  /// for blocks that cannot be read.
  TriangleMesh in_ras() const;

 private:
  voxel::VoxelGrid grid_;
  std::unordered_map<uint32_t, stream::SharedBlock> blocks_;  ///< that hold any surface
};

}  // namespace ream::openigtlink
