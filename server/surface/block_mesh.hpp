#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "geometry/triangle_mesh.hpp"
#include "geometry/vec.hpp"
#include "surface/block_volume.hpp"
#include "voxel/voxel_grid.hpp"

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
  uint32_t block = 0;  ///< as BlockLayout numbers them
  std::vector<BlockVertex> vertices;
  std::vector<uint32_t> indices;
};

/// Position of a vertex in the grid frame. `block` as BlockLayout::coordinates.
Vec3f position_mm(const BlockVertex& vertex, const Vec3i& block, const Vec3& spacing_mm);

/// Extracts the surface at coverage 127.5, which lies between voxel centres; outside the grid coverage is 0,
/// so the surface is closed at the grid's borders. A block owns the cells whose minimum corner voxel lies in
/// it, and the blocks at the grid's minimum sides also the cells between the virtual voxel -1 and voxel 0.
/// Normals are smoothed central differences of coverage, pointing out of the bone. Vertices come in the order
/// of their edges' lower corners, z, then y, then axis, then x, which neighbours therefore agree on.
///
/// At a stride of 2 or 4 the same is done with one sample every 2 or 4 voxels (coarse_samples()): about 1/4
/// or 1/16 of the triangles, in the same units and the same blocks, closed and equal at borders among blocks
/// of the same stride. Holds working memory only: one per thread.
class BlockExtractor {
 public:
  /// Throws Error invalid_input for a stride other than 1, 2 or 4.
  explicit BlockExtractor(const voxel::VoxelGrid& grid, int stride = 1);

  /// `coverage` has grid.voxel_count() bytes in the order of VoxelGrid::index, `block` is below
  /// layout().count().
  BlockMesh extract(const uint8_t* coverage, uint32_t block);

  const BlockLayout& layout() const { return layout_; }

 private:
  void add_vertices(int z, BlockMesh& mesh);
  void add_triangles(int z);
  BlockVertex make_vertex(int axis, int x, int y, int z) const;

  BlockLayout layout_;
  Vec3f voxels_per_mm_;
  BlockVolume volume_;
  std::vector<uint32_t> vertex_of_edge_;  ///< of two slices in turn
  std::vector<uint32_t> indices_;         ///< of the block in progress, the first index_count_
  size_t index_count_ = 0;
};

/// Octahedral map of a direction (any length but zero) to two signed bytes, and back to a unit vector: the
/// octahedron |x| + |y| + |z| = 1 seen from +z, its lower half folded over the corners, -1..1 as -127..127.
/// Error below 1 degree.
std::array<int8_t, 2> octahedral_from_direction(const Vec3f& direction);
Vec3f direction_from_octahedral(int8_t ox, int8_t oy);

/// The whole surface at coverage 127.5 as one closed mesh: grid frame, mm, vertices shared between blocks,
/// outward normals; for files and pictures. `coverage` has grid.voxel_count() bytes in the order of
/// VoxelGrid::index. `stride` as BlockExtractor. The same for the same coverage, whatever the number of
/// threads. Throws as validate() and BlockExtractor.
TriangleMesh whole_surface(const voxel::VoxelGrid& grid, const uint8_t* coverage, int threads = 2,
                           int stride = 1);

}  // namespace ream::surface
