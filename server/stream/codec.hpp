#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "stream/removed_bone.hpp"
#include "stream/surface_classes.hpp"
#include "surface/block_mesh.hpp"

namespace ream::stream {

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
