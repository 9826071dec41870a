#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "surface/block_layout.hpp"

namespace ream::surface {

/// Vertices are whole numbers of 1/1024 voxel, so blocks that share a vertex agree on it to the bit.
inline constexpr int units_per_voxel = 1024;

/// As it goes over the wire: position in 1/1024 voxel from the block's minimum corner minus one voxel (voxel
/// centres are at n + 0.5 voxels), then the outward normal, octahedral. The normal is of the grid frame in
/// mm, not in voxels.
struct BlockVertex {
  uint16_t x, y, z;
  int8_t ox, oy;
  bool operator==(const BlockVertex&) const = default;
};
static_assert(sizeof(BlockVertex) == 8);

/// Surface of one 32^3 block: triangles counter-clockwise from outside, three indices each; both empty where
/// the block holds no surface. Every vertex is used, and its position is unique within the block.
struct BlockMesh {
  uint32_t block = 0;  ///< x + bx * (y + by * z)
  std::vector<BlockVertex> vertices;
  std::vector<uint32_t> indices;
};

/// Position of a vertex in the grid frame. `block` as Replica::block_coordinates.
Vec3f position_mm(const BlockVertex& vertex, const Vec3i& block, const Vec3& spacing_mm);

/// Extracts the surface at coverage 127.5, which lies between voxel centres; outside the grid coverage is 0,
/// so the surface is closed at the grid's borders. A block owns the cells whose minimum corner voxel lies in
/// it, and the blocks at the grid's minimum sides also the cells between the virtual voxel -1 and voxel 0.
/// Normals are smoothed central differences of coverage, pointing out of the bone. Holds working memory only:
/// one per thread.
class BlockExtractor {
 public:
  explicit BlockExtractor(const voxel::VoxelGrid& grid);

  /// `coverage` has grid.voxel_count() bytes in grid order, `block` is below block_count().
  BlockMesh extract(const uint8_t* coverage, uint32_t block);

  Vec3i block_dims() const { return block_dims_; }
  uint32_t block_count() const { return static_cast<uint32_t>(block_dims_.prod()); }
  Vec3i block_coordinates(uint32_t block) const;

 private:
  /// Copies the block with two voxels around it; false when it holds no surface.
  bool load(const uint8_t* coverage, const Vec3i& block);
  /// `count` voxels along x from `from`, gathered from the bricks they lie in.
  void copy_row(const uint8_t* coverage, const Vec3i& from, int count, uint8_t* to) const;
  void add_vertices(int z, BlockMesh& mesh);
  void add_triangles(int z, BlockMesh& mesh) const;
  void add_vertex(int axis, int x, int y, int z, BlockMesh& mesh);

  voxel::VoxelGrid grid_;
  Vec3i block_dims_;
  Vec3f voxels_per_mm_;
  Vec3i low_ = Vec3i::Zero();     ///< first corner of owned cells, in the copy
  std::vector<uint8_t> copy_;     ///< coverage, rows padded to row_bytes
  std::vector<uint64_t> filled_;  ///< one word per row of the copy: bit x is set where coverage > 127.5
  std::vector<uint32_t> vertex_of_edge_;  ///< of two slices in turn
};

}  // namespace ream::surface
