#include "openigtlink/bone_picture.hpp"

#include <algorithm>
#include <array>

#include "core/hash.hpp"
#include "openigtlink/messages.hpp"
#include "surface/block_layout.hpp"
#include "surface/block_mesh.hpp"

namespace ream::openigtlink {
namespace {

/// Where a vertex is in the whole grid, in 1/1024 voxel: blocks that share it agree on this to the bit.
using PlaceUnits = std::array<uint32_t, 3>;

PlaceUnits place_of(const surface::BlockVertex& vertex, const Vec3i& block) {
  constexpr int block_units = surface::block_edge * surface::units_per_voxel;
  return {static_cast<uint32_t>(block.x() * block_units + vertex.x),
          static_cast<uint32_t>(block.y() * block_units + vertex.y),
          static_cast<uint32_t>(block.z() * block_units + vertex.z)};
}

struct PlaceHash {
  size_t operator()(const PlaceUnits& place) const noexcept {
    return hash_combine(uint64_t{place[0]} << 32 | place[1], place[2]);
  }
};

}  // namespace

void BonePicture::take(stream::SharedBlock block) {
  if (block->empty())
    blocks_.erase(block->block);
  else
    blocks_[block->block] = std::move(block);
}

TriangleMesh BonePicture::in_ras() const {
  const surface::BlockLayout layout(grid_);
  const Pose ras_from_grid = ras_from(grid_.world_from_grid);
  std::vector<uint32_t> order;
  size_t vertices = 0, triangles = 0;
  for (const auto& [key, block] : blocks_) {
    order.push_back(key);
    vertices += block->vertex_count;
    triangles += block->index_count / 3;
  }
  std::sort(order.begin(), order.end());
  TriangleMesh whole;
  whole.vertices_mm.reserve(vertices);
  whole.normals.reserve(vertices);
  whole.triangles.reserve(triangles);
  std::unordered_map<PlaceUnits, uint32_t, PlaceHash> number_of;
  number_of.reserve(vertices);
  std::vector<uint32_t> number;
  for (const uint32_t key : order) {
    const surface::BlockMesh mesh = stream::decode(*blocks_.at(key));
    const Vec3i block = layout.coordinates(key);
    number.clear();
    for (const surface::BlockVertex& v : mesh.vertices) {
      const auto [place, is_new] =
          number_of.try_emplace(place_of(v, block), static_cast<uint32_t>(whole.vertices_mm.size()));
      number.push_back(place->second);
      if (!is_new) continue;
      const Vec3 place_mm = surface::position_mm(v, block, grid_.spacing_mm).cast<double>();
      whole.vertices_mm.push_back(ras_from_grid.point(place_mm).cast<float>());
      const Vec3 normal = surface::direction_from_octahedral(v.ox, v.oy).cast<double>();
      whole.normals.push_back(ras_from_grid.direction(normal).cast<float>());
    }
    for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
      whole.triangles.push_back(
          {number[mesh.indices[i]], number[mesh.indices[i + 1]], number[mesh.indices[i + 2]]});
  }
  return whole;
}

}  // namespace ream::openigtlink
