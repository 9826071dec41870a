#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "stream/removed_bone.hpp"
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

/// A block's surface as it travels: meshopt vertex stream (codec v0) of BlockVertex and meshopt index stream
/// (codec v1) of triangles. Both are empty, and both counts 0, where the block holds no surface.
struct EncodedBlock {
  uint32_t block = 0;
  uint32_t revision = 0;  ///< grows per block
  uint32_t tick = 0;      ///< the newest brick in it
  int stride = 1;         ///< of the samples, in voxels; positions are in the same units at every stride
  uint32_t vertex_count = 0, index_count = 0;
  std::vector<std::byte> vertices, indices;
  std::vector<uint8_t> classes;         ///< as MeshBlock.classes; empty where they are not known
  std::vector<uint8_t> removed;         ///< as RemovedBone::packed; empty where nothing is gone
  std::vector<uint8_t> densities = {};  ///< as MeshBlock.densities; empty where removed is, or classes are

  bool empty() const { return index_count == 0; }
  size_t bytes() const {
    return vertices.size() + indices.size() + classes.size() + removed.size() + densities.size();
  }
};

using SharedBlock = std::shared_ptr<const EncodedBlock>;

/// Reorders vertices and triangles so that they pack well; the surface itself is unchanged. A mesh without
/// triangles gives an empty block. `classes` of the bone that the surface bounds, where they are wanted;
/// `removed`: RemovedBone::levels of the mesh's vertices, or empty.
EncodedBlock encode(const surface::BlockMesh& mesh, uint32_t revision, uint32_t tick, int stride = 1,
                    const SurfaceClasses* classes = nullptr, std::span<const uint8_t> removed = {});

/// The surface that was encoded. Error invalid_input for a block that is damaged.
surface::BlockMesh decode(const EncodedBlock& block);

}  // namespace ream::stream
