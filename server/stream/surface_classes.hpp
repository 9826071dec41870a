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

  /// Density code of the voxel three quarters of a sample (`stride` voxels) inside the surface at each vertex
  /// of `block` (as surface::BlockLayout numbers them). A place beside the grid has that of the grid's
  /// nearest voxel. Empty where nothing is known.
  std::vector<uint8_t> codes(std::span<const surface::BlockVertex> vertices, uint32_t block,
                             int stride) const;
  voxel::BoneClass class_of(uint8_t code) const { return class_of_code_[code]; }

  /// Of such codes, as MeshBlock.classes of proto/stream.fbs: 2 bits each, the first in the lowest.
  std::vector<uint8_t> packed_classes(std::span<const uint8_t> codes) const;
  /// And as MeshBlock.densities.
  static std::vector<uint8_t> packed_densities(std::span<const uint8_t> codes);

 private:
  voxel::VoxelGrid grid_;
  voxel::SharedBytes density_;
  std::array<voxel::BoneClass, 256> class_of_code_;
  surface::BlockLayout layout_;
};

}  // namespace ream::stream
