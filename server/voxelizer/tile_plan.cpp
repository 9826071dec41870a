#include "voxelizer/tile_plan.hpp"

#include <algorithm>

#include "voxelizer/lanes.hpp"

namespace ream::voxelizer {
namespace {

/// Sides of tiles are whole bricks.
constexpr int side_step = 8;
constexpr size_t triangles_a_piece = 8192;

int whole_steps(double rows, int most) {
  const double steps = std::floor(std::max(1.0, rows / side_step));
  const int whole = (most + side_step - 1) / side_step * side_step;
  return static_cast<int>(std::min(steps * side_step, static_cast<double>(whole)));
}

/// Tiles that a triangle's box may touch, inclusive; none when first > last.
struct Span {
  int first_v, last_v, first_w, last_w;
};

struct Spans {
  const TriangleMesh& mesh;
  const VoxelMap& map;
  const TilePlan& plan;
  double tiles_a_row, tiles_a_layer;

  Spans(const TriangleMesh& a_mesh, const VoxelMap& a_map, const TilePlan& a_plan)
      : mesh(a_mesh),
        map(a_map),
        plan(a_plan),
        tiles_a_row(1.0 / a_plan.rows),
        tiles_a_layer(1.0 / a_plan.layers) {}

  /// A voxel more on either side than the corners need: rounding is decided where voxels are marked.
  Span of(size_t triangle) const {
    const auto& indices = mesh.triangles[triangle];
    const float* a = mesh.vertices_mm[indices[0]].data();
    const float* b = mesh.vertices_mm[indices[1]].data();
    const float* c = mesh.vertices_mm[indices[2]].data();
    const auto voxel = [&](float coordinate, size_t k) {
      return static_cast<double>(coordinate) * map.factor[k] + map.offset[k];
    };
    const auto lowest = [&](int k, size_t axis) { return voxel(std::min({a[k], b[k], c[k]}), axis) - 1.5; };
    const auto highest = [&](int k, size_t axis) { return voxel(std::max({a[k], b[k], c[k]}), axis) + 0.5; };
    return {floor_between(lowest(1, 1) * tiles_a_row, 0, plan.count_v),
            floor_between(highest(1, 1) * tiles_a_row, -1, plan.count_v - 1),
            floor_between(lowest(2, 2) * tiles_a_layer, 0, plan.count_w),
            floor_between(highest(2, 2) * tiles_a_layer, -1, plan.count_w - 1)};
  }

  template <class Visit>
  void for_each_tile(size_t triangle, Visit visit) const {
    const Span span = of(triangle);
    for (int j = span.first_w; j <= span.last_w; ++j)
      for (int i = span.first_v; i <= span.last_v; ++i)
        visit(static_cast<size_t>(i) + static_cast<size_t>(plan.count_v) * static_cast<size_t>(j));
  }
};

}  // namespace

RowRange TilePlan::range(size_t tile) const {
  const int i = static_cast<int>(tile % static_cast<size_t>(count_v));
  const int j = static_cast<int>(tile / static_cast<size_t>(count_v));
  return {i * rows, std::min((i + 1) * rows, dims.y()), j * layers, std::min((j + 1) * layers, dims.z())};
}

TilePlan plan_tiles(const RasterGrid& grid, size_t tile_bytes, size_t least_tiles, bool whole_layers) {
  TilePlan plan;
  plan.dims = grid.dims;
  const double row_bytes = 4.0 * static_cast<double>(grid.words_per_row());
  const double rows = static_cast<double>(tile_bytes) / row_bytes;
  plan.rows = whole_layers ? grid.dims.y() : whole_steps(rows / side_step, grid.dims.y());
  const double layers = std::min(rows / plan.rows, grid.dims.z() / static_cast<double>(least_tiles));
  plan.layers = whole_layers && layers < side_step ? std::max(1, static_cast<int>(layers))
                                                   : whole_steps(layers, grid.dims.z());
  plan.count_v = (grid.dims.y() + plan.rows - 1) / plan.rows;
  plan.count_w = (grid.dims.z() + plan.layers - 1) / plan.layers;
  return plan;
}

TileBins::TileBins(const TriangleMesh& mesh, const VoxelMap& map, const TilePlan& plan, Crew& crew,
                   size_t most_bytes)
    : triangles_(mesh.triangles.size()) {
  const Spans spans(mesh, map, plan);
  const size_t tiles = plan.count();
  const size_t pieces =
      std::clamp<size_t>(triangles_ / triangles_a_piece, 1, 4 * static_cast<size_t>(crew.threads()));
  if (tiles * pieces * sizeof(size_t) > most_bytes || tiles == 1) return;
  // Each piece counts, then fills its own part of every list, so that lists keep the mesh's order.
  std::vector<size_t> places(tiles * pieces, 0);
  const auto piece_begin = [&](size_t piece) { return triangles_ * piece / pieces; };
  crew.run(pieces, [&](size_t piece, int) {
    size_t* counts = places.data() + piece * tiles;
    for (size_t t = piece_begin(piece); t < piece_begin(piece + 1); ++t)
      spans.for_each_tile(t, [&](size_t tile) { ++counts[tile]; });
  });
  first_.resize(tiles + 1);
  size_t total = 0;
  for (size_t tile = 0; tile < tiles; ++tile) {
    first_[tile] = total;
    for (size_t piece = 0; piece < pieces; ++piece) {
      const size_t count = places[piece * tiles + tile];
      places[piece * tiles + tile] = total;
      total += count;
    }
  }
  first_[tiles] = total;
  if (total * sizeof(uint32_t) > most_bytes) return;
  list_.resize(total);
  crew.run(pieces, [&](size_t piece, int) {
    size_t* next = places.data() + piece * tiles;
    for (size_t t = piece_begin(piece); t < piece_begin(piece + 1); ++t)
      spans.for_each_tile(t, [&](size_t tile) { list_[next[tile]++] = static_cast<uint32_t>(t); });
  });
  listed_ = true;
}

}  // namespace ream::voxelizer
