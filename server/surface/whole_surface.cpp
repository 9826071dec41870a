#include <algorithm>
#include <optional>
#include <vector>

#include "core/thread_pool.hpp"
#include "surface/block_layout.hpp"
#include "surface/block_mesh.hpp"
#include "surface/surface_parts.hpp"

namespace ream::surface {
namespace {

/// Calls work(item) for all items below count, on that many threads. What it throws is thrown here.
template <typename MakeWork>
void in_parallel(uint32_t count, int threads, MakeWork make_work) {
  ThreadPool pool(threads);
  std::vector<std::optional<decltype(make_work())>> works(static_cast<size_t>(pool.threads()));
  pool.run(count, [&](size_t item, int worker) {
    auto& work = works[static_cast<size_t>(worker)];
    if (!work) work.emplace(make_work());
    (*work)(static_cast<uint32_t>(item));
  });
}

std::vector<Fill> fills(const voxel::VoxelGrid& grid, const uint8_t* coverage, int threads) {
  std::vector<Fill> result(grid.brick_count());
  const auto row = static_cast<uint32_t>(grid.brick_dims().x());
  in_parallel(static_cast<uint32_t>(grid.brick_count()) / row, threads, [&] {
    return [&](uint32_t y) {
      for (uint32_t brick = y * row; brick < (y + 1) * row; ++brick)
        result[brick] = fill_of(coverage + size_t{brick} * voxel::brick_voxels);
    };
  });
  return result;
}

}  // namespace

TriangleMesh whole_surface(const voxel::VoxelGrid& grid, const uint8_t* coverage, int threads, int stride) {
  validate(grid);
  threads = std::max(1, threads);
  const BlockLayout layout(grid);
  const BlockExtractor checks_stride(grid, stride);  // here, where an Error can be caught
  const std::vector<Fill> bricks = fills(grid, coverage, threads);
  std::vector<SurfacePart> parts(layout.count());
  in_parallel(layout.count(), threads, [&] {
    return [&, extractor = BlockExtractor(grid, stride)](uint32_t block) mutable {
      const auto fill_at = [&](uint32_t brick) { return bricks[brick]; };
      if (!may_hold_surface(grid, layout.coordinates(block), fill_at)) return;
      parts[block].mesh = extractor.extract(coverage, block);
      count_owned(parts[block], stride);
    };
  });
  TriangleMesh whole = lay_out(parts);
  in_parallel(layout.count(), threads, [&] {
    return [&](uint32_t block) { join(layout, grid.spacing_mm, stride, parts, parts[block], whole); };
  });
  return whole;
}

}  // namespace ream::surface
