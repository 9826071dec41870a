#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/triangle_mesh.hpp"
#include "surface/block_layout.hpp"
#include "surface/block_mesh.hpp"

namespace ream::surface {

/// A block's part of the whole surface. Where blocks meet, a vertex is owned by the block of its edge's lower
/// corner. The others borrow it: those vertices of a block that lie behind it along a set of axes are owned
/// by its neighbour along these axes, which has them on its first layers, in the same order (BlockExtractor).
/// So a borrowed vertex is found by counting.
struct SurfacePart {
  static constexpr size_t axis_sets = 8;  ///< sets of axes as bits 0 to 2

  BlockMesh mesh;
  uint32_t owned = 0;
  size_t first_vertex = 0, first_triangle = 0;
  std::array<std::vector<uint32_t>, axis_sets> lent;  ///< by set of axes: which of the owned vertices
};

/// Parts, one for each block, that become one closed mesh: in the grid frame, mm, vertices shared, outward
/// normals. First count_owned() of each part, then lay_out() once, then join() of each, in any order and on
/// any threads.
void count_owned(SurfacePart& part, int stride);
TriangleMesh lay_out(std::vector<SurfacePart>& parts);
void join(const BlockLayout& layout, const Vec3& spacing_mm, int stride,
          const std::vector<SurfacePart>& parts, const SurfacePart& part, TriangleMesh& whole);

}  // namespace ream::surface
