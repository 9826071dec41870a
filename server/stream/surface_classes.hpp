#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "surface/block_mesh.hpp"
#include "voxel/bone_model.hpp"

namespace ream::stream {

/// Tells what kind of bone lies right under a surface, so that viewers can colour it. Shares the bone's
/// density, which never changes; of a bone without densities nothing is known.
class SurfaceClasses {
 public:
  explicit SurfaceClasses(const voxel::BoneModel& bone);

  /// Of a bone with densities. Class of the voxel three quarters of a sample (`stride` voxels) inside the
  /// surface at a vertex of `block` (as surface::BlockLayout numbers them). A place beside the grid has the
  /// class of the grid's nearest voxel.
  voxel::BoneClass under(const surface::BlockVertex& vertex, uint32_t block, int stride) const;

  /// The same of all vertices, as MeshBlock.classes of proto/stream.fbs: 2 bits each, the first in the
  /// lowest; empty where nothing is known.
  std::vector<uint8_t> packed(std::span<const surface::BlockVertex> vertices, uint32_t block,
                              int stride) const;

 private:
  voxel::VoxelGrid grid_;
  voxel::SharedBytes density_;
  std::array<voxel::BoneClass, 256> class_of_code_;
  surface::BlockLayout layout_;
};

}  // namespace ream::stream
