#include "voxelizer/voxelizer.hpp"

#include <algorithm>
#include <numeric>
#include <sstream>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "voxelizer/triangle_marking.hpp"

namespace ream::voxelizer {
namespace {

uint64_t edge_key(uint32_t a, uint32_t b) {
  return static_cast<uint64_t>(std::min(a, b)) << 32 | std::max(a, b);
}

template <class Visit>
void for_each_edge(const TriangleMesh& mesh, Visit visit) {
  for (const auto& t : mesh.triangles)
    for (size_t k = 0; k < 3; ++k) visit(edge_key(t[k], t[(k + 1) % 3]));
}

std::vector<uint64_t> open_edges(const TriangleMesh& mesh) {
  std::vector<uint64_t> edges, open;
  edges.reserve(3 * mesh.triangles.size());
  for_each_edge(mesh, [&](uint64_t key) { edges.push_back(key); });
  std::sort(edges.begin(), edges.end());
  for (auto first = edges.begin(); first != edges.end();) {
    const auto end = std::upper_bound(first, edges.end(), *first);
    if ((end - first) % 2 != 0) open.push_back(*first);
    first = end;
  }
  return open;
}

}  // namespace

void require_closed(const TriangleMesh& mesh, double scale) {
  // Edges that come twice cancel out in the sums, which then are 0 but for one chance in 2^128; no memory is
  // needed unless the mesh is refused.
  uint64_t sum = 0, other_sum = 0;
  for_each_edge(mesh, [&](uint64_t key) {
    const uint64_t number = mix64(key);
    sum ^= number;
    other_sum ^= mix64(number ^ key);
  });
  if (sum == 0 && other_sum == 0) return;
  const std::vector<uint64_t> open = open_edges(mesh);
  const Vec3 a = scale * mesh.vertices_mm[open.front() >> 32].cast<double>();
  const Vec3 b = scale * mesh.vertices_mm[open.front() & 0xffffffffu].cast<double>();
  const Vec3 middle = 0.5 * (a + b);
  std::ostringstream text;
  text << "the mesh is not closed and has no inside to fill: " << open.size()
       << (open.size() == 1 ? " edge belongs" : " edges belong")
       << " to an odd number of triangles, the first near (" << middle.x() << ", " << middle.y() << ", "
       << middle.z() << ") mm; close it, or leave out --solid";
  throw Error(ErrorKind::invalid_input, text.str());
}

namespace {

constexpr size_t dense_tile_bytes = size_t{1} << 20;
constexpr size_t sparse_tile_bytes = size_t{2} << 20;
constexpr size_t tiles_a_thread = 3;

}  // namespace

TilePlan default_tiles(const VoxelSet& set, int threads) {
  return plan_tiles(set.grid(), set.sparse() ? sparse_tile_bytes : dense_tile_bytes,
                    tiles_a_thread * static_cast<size_t>(threads));
}

void Voxelizer::voxelize(const TriangleMesh& mesh, const Request& request, VoxelSet& set,
                         const Progress& progress) {
  const TilePlan plan = default_tiles(set, pool_.threads());
  const VoxelMap map = voxel_map(set.grid(), request.scale);
  const TileBins bins(mesh, map, plan, pool_);
  const SurfaceMarker surface{mesh, map, bins, request.separability};
  const SolidFiller solid{mesh, map, bins};
  const int dims_x = set.grid().dims.x();
  const auto workers = static_cast<size_t>(pool_.threads());
  std::vector<std::vector<uint32_t>> memory(workers);
  std::vector<uint64_t> filled(plan.count(), 0);
  if (set.sparse()) set.begin_bricks(plan);
  const std::vector<size_t> order = bins.largest_first(plan.count());
  pool_.run(
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
