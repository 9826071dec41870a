#pragma once
#include <array>
#include <vector>

#include "core/crew.hpp"
#include "voxelizer/raster_grid.hpp"

namespace ream::voxelizer {

/// A triangle's number and which part of its box, counted strip by strip, then block of layers by block.
using TriangleTask = std::array<uint32_t, 2>;

/// Work-items of about equal work for triangles first to end - 1 within some rows of a grid: large triangles
/// make many. Replaces `tasks`.
void list_tasks(const TriangleMesh& mesh, const VoxelMap& map, int dims_x, const RowRange& rows, size_t first,
                size_t end, Crew& crew, std::vector<TriangleTask>& tasks);

}  // namespace ream::voxelizer
