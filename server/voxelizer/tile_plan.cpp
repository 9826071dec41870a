#include "voxelizer/tile_plan.hpp"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <numeric>

#include "core/vector_clones.hpp"
#include "voxelizer/lanes.hpp"

namespace ream::voxelizer {
namespace {

/// Sides of tiles are whole bricks.
constexpr int side_step = 8;
constexpr size_t triangles_a_piece = 1024;

int whole_steps(double rows, int most) {
  const double steps = std::floor(std::max(1.0, rows / side_step));
  const int whole = (most + side_step - 1) / side_step * side_step;
  return static_cast<int>(std::min(steps * side_step, static_cast<double>(whole)));
}

/// Tiles that the boxes of eight triangles may touch, inclusive, none where first > last; and their sizes.
struct Spans {
  Int8 first_v, last_v, first_w, last_w, size;

  /// Triangles from `first` on. A voxel more on either side than the corners need: rounding is decided where
  /// voxels are marked.
  void set(const TriangleMesh& mesh, const VoxelMap& map, const TilePlan& plan, size_t first, size_t end) {
    float corners[3][2][8];
    for (size_t lane = 0; lane < 8; ++lane) {
      const auto& indices = mesh.triangles[std::min(first + lane, end - 1)];
      for (size_t i = 0; i < 3; ++i) {
        const float* corner = mesh.vertices_mm[indices[i]].data();
        corners[i][0][lane] = corner[1];
        corners[i][1][lane] = corner[2];
      }
    }
    const auto tiles = [&](size_t axis, double tiles_a_voxel, int count, Int8& from, Int8& to) {
      Float8 a, b, c;
      std::memcpy(&a, corners[0][axis - 1], sizeof a);
      std::memcpy(&b, corners[1][axis - 1], sizeof b);
      std::memcpy(&c, corners[2][axis - 1], sizeof c);
      const auto voxel = [&](const Float8& x) __attribute__((always_inline)) {
        return __builtin_convertvector(x, Double8) * map.factor[axis] + map.offset[axis];
      };
      const Double8 least = voxel(smaller(smaller(a, b), c)), most = voxel(larger(larger(a, b), c));
      from = floor_between((least - 1.5) * tiles_a_voxel, 0, count);
      to = floor_between((most + 0.5) * tiles_a_voxel, -1, count - 1);
      return floor_between(rounded_down(most) - rounded_down(least), 1, BoxSize::sides) - 1;
    };
    const Int8 rows = tiles(1, 1.0 / plan.rows, plan.count_v, first_v, last_v);
    const Int8 layers = tiles(2, 1.0 / plan.layers, plan.count_w, first_w, last_w);
    size = rows + BoxSize::sides * layers;
  }
};

/// False when the lists have become too long.
REAM_VECTOR_CLONES __attribute__((flatten)) bool list_triangles(const TriangleMesh& mesh, const VoxelMap& map,
                                                                const TilePlan& plan, size_t begin,
                                                                size_t end, TriangleLists& lists) {
  Spans spans;
  for (size_t first = begin; first < end; first += 8) {
    spans.set(mesh, map, plan, first, end);
    const int count = static_cast<int>(std::min<size_t>(8, end - first));
    for (int lane = 0; lane < count; ++lane) {
      const auto triangle = static_cast<uint32_t>(first) + static_cast<uint32_t>(lane);
      const auto size = static_cast<uint8_t>(spans.size[lane]);
      for (int w = spans.first_w[lane]; w <= spans.last_w[lane]; ++w)
        for (int v = spans.first_v[lane]; v <= spans.last_v[lane]; ++v)
          if (!lists.add(static_cast<size_t>(v) + static_cast<size_t>(plan.count_v) * static_cast<size_t>(w),
                         triangle, size))
            return false;
    }
  }
  return true;
}

}  // namespace

RowRange TilePlan::range(size_t tile) const {
  const int i = static_cast<int>(tile % static_cast<size_t>(count_v));
  const int j = static_cast<int>(tile / static_cast<size_t>(count_v));
  return {i * rows, std::min((i + 1) * rows, dims.y()), j * layers, std::min((j + 1) * layers, dims.z())};
}

TilePlan plan_tiles(const RasterGrid& grid, size_t tile_bytes, size_t min_tiles, bool whole_layers) {
  TilePlan plan;
  plan.dims = grid.dims;
  const double row_bytes = 4.0 * static_cast<double>(grid.words_per_row());
  const double rows = static_cast<double>(tile_bytes) / row_bytes;
  plan.rows = whole_layers ? grid.dims.y() : whole_steps(rows / side_step, grid.dims.y());
  const double share = std::round(grid.dims.z() / static_cast<double>(side_step * min_tiles)) * side_step;
  const double layers = std::min(rows / plan.rows, std::max<double>(share, side_step));
  plan.layers = whole_layers && layers < side_step ? std::max(1, static_cast<int>(layers))
                                                   : whole_steps(layers, grid.dims.z());
  plan.count_v = (grid.dims.y() + plan.rows - 1) / plan.rows;
  plan.count_w = (grid.dims.z() + plan.layers - 1) / plan.layers;
  return plan;
}

TileBins::TileBins(const TriangleMesh& mesh, const VoxelMap& map, const TilePlan& plan, ThreadPool& pool,
                   size_t max_bytes)
    : triangles_(mesh.triangles.size()) {
  const auto workers = static_cast<size_t>(pool.threads());
  if (plan.count() == 1 || TriangleLists::min_bytes(plan.count(), workers) > max_bytes) return;
  TriangleLists::Budget budget(max_bytes);
  for (size_t worker = 0; worker < workers; ++worker) lists_.emplace_back(plan.count(), budget);
  std::atomic<bool> fits = true;
  const size_t pieces = (triangles_ + triangles_a_piece - 1) / triangles_a_piece;
  pool.run(pieces, [&](size_t piece, int worker) {
    const size_t begin = piece * triangles_a_piece;
    if (fits && !list_triangles(mesh, map, plan, begin, std::min(begin + triangles_a_piece, triangles_),
                                lists_[static_cast<size_t>(worker)]))
      fits = false;
  });
  listed_ = fits;
  if (!listed_) lists_.clear();
}

std::vector<size_t> TileBins::largest_first(size_t tiles) const {
  std::vector<size_t> order(tiles), sizes(tiles, 0);
  std::iota(order.begin(), order.end(), size_t{0});
  for (const TriangleLists& lists : lists_)
    for (size_t tile = 0; tile < tiles; ++tile) sizes[tile] += lists.size(tile);
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return sizes[a] > sizes[b]; });
  return order;
}

}  // namespace ream::voxelizer
