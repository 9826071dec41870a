#include "surface/whole_surface.hpp"

#include <algorithm>
#include <atomic>
#include <thread>
#include <unordered_map>

#include "core/hash.hpp"
#include "surface/block_mesh.hpp"
#include "surface/octahedral.hpp"

namespace ream::surface {
namespace {

using GridPosition = std::array<int32_t, 3>;  ///< 1/1024 voxel

struct GridPositionHash {
  size_t operator()(const GridPosition& p) const {
    const uint64_t xy =
        static_cast<uint64_t>(static_cast<uint32_t>(p[0])) << 32 | static_cast<uint32_t>(p[1]);
    return mix64(xy ^ mix64(static_cast<uint32_t>(p[2])));
  }
};

std::vector<BlockMesh> extract_all(const voxel::VoxelGrid& grid, const uint8_t* coverage, int threads) {
  const uint32_t count = BlockLayout(grid).count();
  std::vector<BlockMesh> meshes(count);
  std::atomic<uint32_t> next{0};
  const auto work = [&] {
    BlockExtractor extractor(grid);
    for (uint32_t block = next++; block < count; block = next++)
      meshes[block] = extractor.extract(coverage, block);
  };
  std::vector<std::jthread> helpers;
  for (int i = 1; i < threads; ++i) helpers.emplace_back(work);
  work();
  helpers.clear();
  return meshes;
}

/// Joins blocks in their order. Only vertices on planes through voxel centres where two blocks meet can be
/// shared.
class Welder {
 public:
  explicit Welder(const voxel::VoxelGrid& grid) : spacing_mm_(grid.spacing_mm) {}

  void add(const BlockMesh& block, const Vec3i& coordinates) {
    const Vec3i origin = ((coordinates * block_edge).array() - 1) * units_per_voxel;
    index_.clear();
    for (const BlockVertex& v : block.vertices) {
      const auto fresh = static_cast<uint32_t>(mesh.vertices_mm.size());
      uint32_t index = fresh;
      if (at_border(v.x) || at_border(v.y) || at_border(v.z))
        index =
            shared_.try_emplace({origin.x() + v.x, origin.y() + v.y, origin.z() + v.z}, fresh).first->second;
      index_.push_back(index);
      if (index != fresh) continue;
      mesh.vertices_mm.push_back(position_mm(v, coordinates, spacing_mm_));
      mesh.normals.push_back(direction_from_octahedral(v.ox, v.oy));
    }
    for (size_t i = 0; i < block.indices.size(); i += 3)
      mesh.triangles.push_back(
          {index_[block.indices[i]], index_[block.indices[i + 1]], index_[block.indices[i + 2]]});
  }

  TriangleMesh mesh;

 private:
  static bool at_border(uint16_t position) {
    constexpr int low = units_per_voxel + units_per_voxel / 2;
    return position == low || position == low + block_edge * units_per_voxel;
  }

  Vec3 spacing_mm_;
  std::unordered_map<GridPosition, uint32_t, GridPositionHash> shared_;
  std::vector<uint32_t> index_;
};

}  // namespace

TriangleMesh whole_surface(const voxel::VoxelGrid& grid, const uint8_t* coverage, int threads) {
  validate(grid);
  std::vector<BlockMesh> meshes = extract_all(grid, coverage, std::max(1, threads));
  size_t vertices = 0, triangles = 0;
  for (const BlockMesh& block : meshes) {
    vertices += block.vertices.size();
    triangles += block.indices.size() / 3;
  }
  Welder welder(grid);
  welder.mesh.vertices_mm.reserve(vertices);
  welder.mesh.normals.reserve(vertices);
  welder.mesh.triangles.reserve(triangles);
  const BlockLayout layout(grid);
  for (BlockMesh& block : meshes) {
    welder.add(block, layout.coordinates(block.block));
    block = {};
  }
  return std::move(welder.mesh);
}

}  // namespace ream::surface
