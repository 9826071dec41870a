#include "voxelizer/triangle_tasks.hpp"

#include <algorithm>

#include "core/vector_clones.hpp"
#include "kernels/layout.h"
#include "voxelizer/prepared_triangle.hpp"

namespace ream::voxelizer {
namespace {

constexpr size_t triangles_a_piece = 4096;

/// Parts of the boxes of some triangles, in `parts`.
REAM_VECTOR_CLONES __attribute__((flatten)) void count_parts(const TriangleMesh& mesh, const VoxelMap& map,
                                                             int dims_x, const RowRange& rows, size_t first,
                                                             size_t end, uint32_t* parts) {
  for (size_t triangle = first; triangle < end; ++triangle) {
    PlacedTriangle t;
    uint32_t count = 0;
    if (t.place(mesh, triangle, map, dims_x, rows))
      count = static_cast<uint32_t>((t.high[1] - t.low[1]) / REAM_VOXELIZER_TASK_ROWS + 1) *
              static_cast<uint32_t>((t.high[2] - t.low[2]) / REAM_VOXELIZER_TASK_LAYERS + 1);
    *parts++ = count;
  }
}

}  // namespace

void list_tasks(const TriangleMesh& mesh, const VoxelMap& map, int dims_x, const RowRange& rows, size_t first,
                size_t end, Crew& crew, std::vector<TriangleTask>& tasks) {
  std::vector<uint32_t> parts(end - first);
  const size_t pieces = (end - first + triangles_a_piece - 1) / triangles_a_piece;
  crew.run(pieces, [&](size_t piece, int) {
    const size_t begin = first + piece * triangles_a_piece;
    count_parts(mesh, map, dims_x, rows, begin, std::min(begin + triangles_a_piece, end),
                parts.data() + (begin - first));
  });
  tasks.clear();
  for (size_t i = 0; i < parts.size(); ++i)
    for (uint32_t part = 0; part < parts[i]; ++part)
      tasks.push_back({static_cast<uint32_t>(first + i), part});
}

}  // namespace ream::voxelizer
