#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "core/thread_pool.hpp"
#include "surface/block_layout.hpp"
#include "surface/block_mesh.hpp"

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

/// Sets of axes as bits 0 to 2.
constexpr size_t axis_sets = 8;

/// The axes along which a vertex lies on the block's first, or behind its last, layer of samples.
struct Layers {
  size_t first = 0, behind = 0;
};

Layers layers_of(const BlockVertex& v, int stride) {
  const int first = units_per_voxel + stride * units_per_voxel / 2;
  const int behind = first + block_edge * units_per_voxel;
  const auto set = [&](int at) {
    return static_cast<size_t>((v.x == at) | (v.y == at) << 1 | (v.z == at) << 2);
  };
  return {set(first), set(behind)};
}

/// A block's part of the whole surface. Where blocks meet, a vertex is owned by the block of its edge's lower
/// corner. The others borrow it: those vertices of a block that lie behind it along a set of axes are owned
/// by its neighbour along these axes, which has them on its first layers, in the same order (BlockExtractor).
/// So a borrowed vertex is found by counting.
struct Part {
  BlockMesh mesh;
  uint32_t owned = 0;
  size_t first_vertex = 0, first_triangle = 0;
  std::array<std::vector<uint32_t>, axis_sets> lent;  ///< by set of axes: which of the owned vertices
};

void count_owned(Part& part, int stride) {
  for (const BlockVertex& v : part.mesh.vertices) {
    const Layers layers = layers_of(v, stride);
    if (layers.behind != 0) continue;
    if (layers.first != 0)
      for (size_t set = 1; set < axis_sets; ++set)
        if ((set & layers.first) == set) part.lent[set].push_back(part.owned);
    ++part.owned;
  }
}

/// Writes the part into the whole, whose arrays have their sizes already.
void join(const BlockLayout& layout, const Vec3& spacing_mm, int stride, const std::vector<Part>& parts,
          const Part& part, TriangleMesh& whole) {
  const Vec3i block = layout.coordinates(part.mesh.block);
  std::array<const Part*, axis_sets> owner{};
  std::array<size_t, axis_sets> borrowed{};
  size_t next = part.first_vertex;
  std::vector<uint32_t> number;
  number.reserve(part.mesh.vertices.size());
  for (const BlockVertex& v : part.mesh.vertices) {
    const size_t set = layers_of(v, stride).behind;
    if (set != 0) {
      if (owner[set] == nullptr)
        owner[set] = &parts[layout.index(block + Vec3i(set & 1, set >> 1 & 1, set >> 2 & 1))];
      number.push_back(
          static_cast<uint32_t>(owner[set]->first_vertex + owner[set]->lent[set][borrowed[set]++]));
      continue;
    }
    whole.vertices_mm[next] = position_mm(v, block, spacing_mm);
    whole.normals[next] = direction_from_octahedral(v.ox, v.oy);
    number.push_back(static_cast<uint32_t>(next++));
  }
  auto triangle = whole.triangles.begin() + static_cast<ptrdiff_t>(part.first_triangle);
  const std::vector<uint32_t>& indices = part.mesh.indices;
  for (size_t i = 0; i < indices.size(); i += 3)
    *triangle++ = {number[indices[i]], number[indices[i + 1]], number[indices[i + 2]]};
}

}  // namespace

TriangleMesh whole_surface(const voxel::VoxelGrid& grid, const uint8_t* coverage, int threads, int stride) {
  validate(grid);
  threads = std::max(1, threads);
  const BlockLayout layout(grid);
  const BlockExtractor checks_stride(grid, stride);  // here, where an Error can be caught
  const std::vector<Fill> bricks = fills(grid, coverage, threads);
  std::vector<Part> parts(layout.count());
  in_parallel(layout.count(), threads, [&] {
    return [&, extractor = BlockExtractor(grid, stride)](uint32_t block) mutable {
      const auto fill_at = [&](uint32_t brick) { return bricks[brick]; };
      if (!may_hold_surface(grid, layout.coordinates(block), fill_at)) return;
      parts[block].mesh = extractor.extract(coverage, block);
      count_owned(parts[block], stride);
    };
  });
  size_t vertices = 0, triangles = 0;
  for (Part& part : parts) {
    part.first_vertex = vertices;
    part.first_triangle = triangles;
    vertices += part.owned;
    triangles += part.mesh.indices.size() / 3;
  }
  TriangleMesh whole;
  whole.vertices_mm.resize(vertices);
  whole.normals.resize(vertices);
  whole.triangles.resize(triangles);
  in_parallel(layout.count(), threads, [&] {
    return [&](uint32_t block) { join(layout, grid.spacing_mm, stride, parts, parts[block], whole); };
  });
  return whole;
}

}  // namespace ream::surface
