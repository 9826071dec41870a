#include "voxelizer/voxelizer_cl.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "core/error.hpp"
#include "core/thread_pool.hpp"
#include "core/vector_clones.hpp"
#include "kernels/layout.h"
#include "voxelizer/prepared_triangle.hpp"
#include "voxelizer/raster_grid.hpp"

namespace ream::voxelizer {
namespace {

/// A triangle's number and which part of its box, counted strip by strip, then block of layers by block.
using TriangleTask = std::array<uint32_t, 2>;

/// Work-items of about equal work for triangles first to end - 1 within some rows of a grid: large triangles
/// make many. Replaces `tasks`.
void list_tasks(const TriangleMesh& mesh, const VoxelMap& map, int dims_x, const RowRange& rows, size_t first,
                size_t end, ThreadPool& pool, std::vector<TriangleTask>& tasks);

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

void list_tasks(const TriangleMesh& mesh, const VoxelMap& map, int dims_x, const RowRange& rows, size_t first,
                size_t end, ThreadPool& pool, std::vector<TriangleTask>& tasks) {
  std::vector<uint32_t> parts(end - first);
  const size_t pieces = (end - first + triangles_a_piece - 1) / triangles_a_piece;
  pool.run(pieces, [&](size_t piece, int) {
    const size_t begin = first + piece * triangles_a_piece;
    count_parts(mesh, map, dims_x, rows, begin, std::min(begin + triangles_a_piece, end),
                parts.data() + (begin - first));
  });
  tasks.clear();
  for (size_t i = 0; i < parts.size(); ++i)
    for (uint32_t part = 0; part < parts[i]; ++part)
      tasks.push_back({static_cast<uint32_t>(first + i), part});
}

constexpr size_t local_size = 16;
/// Triangles whose tasks are listed at once.
constexpr size_t triangles_a_batch = size_t{1} << 18;
/// Bits that are worked on at once where a set keeps bricks.
constexpr size_t sparse_band_bytes = size_t{16} << 20;
constexpr size_t max_band_bytes = size_t{1} << 31;

std::span<const float> floats_of(const TriangleMesh& mesh) {
  static_assert(sizeof(Vec3f) == 3 * sizeof(float));
  return {mesh.vertices_mm.front().data(), 3 * mesh.vertices_mm.size()};
}

std::span<const uint32_t> indices_of(const TriangleMesh& mesh) {
  return {mesh.triangles.front().data(), 3 * mesh.triangles.size()};
}

layout::VoxelizerArguments arguments_of(const RasterGrid& grid, const RowRange& range, bool thin) {
  return {0,
          grid.dims.x(),
          range.v_begin,
          range.v_end,
          range.w_begin,
          range.w_end,
          static_cast<int32_t>(grid.words_per_row()),
          range.v_end - range.v_begin,
          thin};
}

const gpu::Queue& with_doubles(const gpu::Queue& queue) {
  if (!queue.device().knows_doubles)
    throw Error(ErrorKind::unavailable,
                queue.device().name + " has no double precision, which voxelizing needs; use --backend cpu");
  return queue;
}

}  // namespace

/// A mesh on the device.
struct VoxelizerCl::Meshed {
  Meshed(const gpu::Queue& queue, const TriangleMesh& a_mesh, const VoxelMap& a_map)
      : mesh(a_mesh),
        map(a_map),
        numbers{a_map.factor[0], a_map.factor[1], a_map.factor[2],
                a_map.offset[0], a_map.offset[1], a_map.offset[2]},
        vertices(gpu::Buffer::over(queue, floats_of(a_mesh))),
        triangles(gpu::Buffer::over(queue, indices_of(a_mesh))),
        map_numbers(gpu::Buffer::copy_of(queue, std::span<const double>(numbers))) {}

  const TriangleMesh& mesh;
  const VoxelMap& map;
  const std::array<double, 6> numbers;
  gpu::Buffer vertices, triangles, map_numbers;
};

VoxelizerCl::VoxelizerCl(const gpu::Queue& queue)
    : queue_(with_doubles(queue)),
      program_(queue, "voxelizer.cl"),
      mark_(program_, "mark_surface"),
      flip_(program_, "flip_solid"),
      fill_(program_, "fill_rows") {
  const gpu::Buffer nothing(queue, 64);
  mark_.set_all(nothing, nothing, nothing, nothing, layout::VoxelizerArguments{}, nothing);
  flip_.set_all(nothing, nothing, nothing, nothing, layout::VoxelizerArguments{}, nothing);
  fill_.set_all(layout::VoxelizerArguments{}, nothing);
  for (const gpu::Kernel* kernel : {&mark_, &flip_, &fill_}) kernel->enqueue(queue, local_size, local_size);
  queue.finish();
}

void VoxelizerCl::voxelize(const TriangleMesh& mesh, const Request& request, VoxelSet& set,
                           const Progress& progress) {
  const RasterGrid& grid = set.grid();
  const VoxelMap map = voxel_map(grid, request.scale);
  const Meshed meshed(queue_, mesh, map);
  const size_t band_bytes = set.sparse() ? sparse_band_bytes : max_band_bytes;
  const TilePlan plan =
      plan_tiles(grid, std::min(band_bytes, queue_.device().max_buffer_bytes / 2), 1, !set.sparse());
  if (set.sparse()) set.begin_bricks(plan);
  std::vector<uint32_t> memory;
  uint64_t filled = 0;
  for (size_t tile = 0; tile < plan.count(); ++tile) {
    progress(static_cast<double>(tile) / static_cast<double>(plan.count()), "marking voxels");
    const TileRows rows = set.rows_of(plan.range(tile), memory);
    mark_band(meshed, grid, request, rows);
    filled += count_marked(rows, pool_);
    if (set.sparse()) set.set_bricks(tile, rows);
  }
  set.set_filled(filled);
}

void VoxelizerCl::mark_band(const Meshed& meshed, const RasterGrid& grid, const Request& request,
                            const TileRows& rows) {
  const RowRange& range = rows.range;
  const std::span<uint32_t> host(rows.words, rows.words_per_row * range.rows());
  gpu::Buffer words =
      queue_.shares_host_memory() ? gpu::Buffer::over(queue_, host) : gpu::Buffer(queue_, host.size_bytes());
  words.fill(queue_, 0);
  if (request.solid) {
    run_tasks(flip_, meshed, grid, false, range, words);
    layout::VoxelizerArguments arguments = arguments_of(grid, range, false);
    arguments.tasks = static_cast<uint32_t>(range.rows());
    fill_.set_all(arguments, words);
    fill_.enqueue(queue_, range.rows(), local_size);
  }
  if (request.surface)
    run_tasks(mark_, meshed, grid, request.separability == Separability::six, range, words);
  queue_.finish();
  if (!words.shared()) words.read(queue_, host.data(), host.size_bytes());
}

void VoxelizerCl::run_tasks(gpu::Kernel& kernel, const Meshed& meshed, const RasterGrid& grid, bool thin,
                            const RowRange& range, const gpu::Buffer& words) {
  layout::VoxelizerArguments arguments = arguments_of(grid, range, thin);
  std::vector<TriangleTask> tasks;
  const size_t triangles = meshed.mesh.triangles.size();
  for (size_t first = 0; first < triangles; first += triangles_a_batch) {
    list_tasks(meshed.mesh, meshed.map, grid.dims.x(), range, first,
               std::min(first + triangles_a_batch, triangles), pool_, tasks);
    if (tasks.empty()) continue;
    const gpu::Buffer listed = gpu::Buffer::over(queue_, std::span<const TriangleTask>(tasks));
    arguments.tasks = static_cast<uint32_t>(tasks.size());
    kernel.set_all(meshed.vertices, meshed.triangles, meshed.map_numbers, listed, arguments, words);
    kernel.enqueue(queue_, tasks.size(), local_size);
    queue_.finish();
  }
}

}  // namespace ream::voxelizer
