#pragma once
#include <cstdint>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace ream::shell {

/// Which voxels a triangle marks: 26-separating is the supercover (eqs 3.1-3.5), 6-separating the thin one
/// (eqs 3.6-3.8).
enum class Separability { six = 6, twenty_six = 26 };

/// One bit a cell, cubic cells, x fastest; 32 cells a word, each row of x starts at a new word so that rows
/// can be written apart.
struct SurfaceVoxels {
  Vec3i dims = Vec3i::Zero();
  Vec3 origin_mm = Vec3::Zero();  ///< minimum corner of cell (0,0,0), frame of the mesh
  double size_mm = 0.0;
  std::vector<uint32_t> words;

  int words_per_row() const { return (dims.x() + 31) / 32; }
  size_t word_index(int u, int v, int w) const {
    return static_cast<size_t>(u / 32) +
           static_cast<size_t>(words_per_row()) *
               (static_cast<size_t>(v) + static_cast<size_t>(dims.y()) * static_cast<size_t>(w));
  }
  bool filled(int u, int v, int w) const { return (words[word_index(u, v, w)] >> (u % 32)) & 1u; }
  size_t filled_cells() const;
};

/// Empty cells around the mesh's box, grown by half a cell on each side so that no surface lies on the
/// border. Throws Error invalid_input for a size that is not positive, or a grid that would not fit in
/// memory.
SurfaceVoxels surface_grid(const TriangleMesh& mesh, double size_mm);

/// Marks the cells of `grid` that the mesh's surface passes, where a point shell gets its points: single
/// precision, for tools. What `ream voxelize` marks is voxelizer/'s, which is exact. Float arithmetic of + -
/// x and comparisons only, so the same bits everywhere: recordings depend on them.
void voxelize_surface_cpu(const TriangleMesh& mesh, Separability separability, SurfaceVoxels& grid);

/// Mesh data of thesis section 3.2: nine floats a triangle, corner after corner, in cells of `grid` from its
/// minimum corner. Computed once in double on the host, so that both back ends start from the same bits and a
/// shared vertex is the same point in all its triangles.
std::vector<float> surface_corners(const TriangleMesh& mesh, const SurfaceVoxels& grid);

}  // namespace ream::shell
