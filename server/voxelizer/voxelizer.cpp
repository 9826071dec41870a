#include "voxelizer/voxelizer.hpp"

#include <numeric>

#include "voxelizer/flip_triangle.hpp"
#include "voxelizer/mark_triangle.hpp"

namespace ream::voxelizer {
namespace {

constexpr size_t tile_bytes = size_t{1} << 20;
constexpr size_t sparse_tile_bytes = size_t{2} << 20;
constexpr size_t tiles_a_thread = 3;

}  // namespace

TilePlan usual_tiles(const VoxelSet& set, int threads) {
  return plan_tiles(set.grid(), set.sparse() ? sparse_tile_bytes : tile_bytes,
                    tiles_a_thread * static_cast<size_t>(threads));
}

void Voxelizer::voxelize(const TriangleMesh& mesh, const Request& request, VoxelSet& set,
                         const Progress& progress) {
  const TilePlan plan = usual_tiles(set, crew_.threads());
  const VoxelMap map = voxel_map(set.grid(), request.scale);
  const TileBins bins(mesh, map, plan, crew_);
  const SurfaceMarker surface{mesh, map, bins, request.separability};
  const SolidFiller solid{mesh, map, bins};
  const int dims_x = set.grid().dims.x();
  const auto workers = static_cast<size_t>(crew_.threads());
  std::vector<std::vector<uint32_t>> memory(workers);
  std::vector<uint64_t> filled(plan.count(), 0);
  if (set.sparse()) set.begin_bricks(plan);
  const std::vector<size_t> order = bins.largest_first(plan.count());
  crew_.run(
      plan.count(),
      [&](size_t piece, int worker) {
        const size_t tile = order[piece];
        const TileRows rows = set.rows_of(plan.range(tile), memory[static_cast<size_t>(worker)]);
        clear(rows);
        if (request.solid) solid.fill(tile, dims_x, rows);
        if (request.surface) surface.mark(tile, dims_x, rows);
        filled[tile] = count_marked(rows);
        if (set.sparse()) set.set_bricks(tile, rows);
      },
      [&](double share) { progress(share, "marking voxels"); });
  set.set_filled(std::accumulate(filled.begin(), filled.end(), uint64_t{0}));
}

}  // namespace ream::voxelizer
