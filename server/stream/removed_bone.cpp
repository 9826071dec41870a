#include "stream/removed_bone.hpp"

namespace ream::stream {
namespace {

constexpr size_t levels_a_byte = 2;

}  // namespace

RemovedBone::RemovedBone(const voxel::VoxelGrid& grid, const std::vector<uint8_t>& now)
    : grid_(grid), now_(now), layout_(grid), place_(grid.brick_count(), 0) {}

void RemovedBone::keep(uint32_t brick, const uint8_t* before) {
  if (place_[brick] != 0) return;
  before_.insert(before_.end(), before, before + voxel::brick_voxels);
  place_[brick] = static_cast<uint32_t>(before_.size() / voxel::brick_voxels);
}

const uint8_t* RemovedBone::kept(uint32_t brick) const {
  const uint32_t place = place_[brick];
  return place == 0 ? nullptr : before_.data() + size_t{place - 1} * voxel::brick_voxels;
}

std::vector<uint8_t> RemovedBone::levels(std::span<const surface::BlockVertex> vertices,
                                         uint32_t block) const {
  if (before_.empty()) return {};
  constexpr int64_t unit = surface::units_per_voxel;
  const Vec3i origin = layout_.coordinates(block) * surface::block_edge - Vec3i::Ones();
  const auto sample = [this](const Vec3i& voxel) { return sample_at(voxel); };
  std::vector<uint8_t> levels;
  levels.reserve(vertices.size());
  unsigned any = 0;
  for (const surface::BlockVertex& vertex : vertices) {
    const std::array<int64_t, 3> at{origin.x() * unit + vertex.x, origin.y() * unit + vertex.y,
                                    origin.z() * unit + vertex.z};
    levels.push_back(static_cast<uint8_t>(surface::removed_level(at, max_level, sample)));
    any |= levels.back();
  }
  if (any == 0) return {};
  return levels;
}

std::vector<uint8_t> RemovedBone::packed(std::span<const uint8_t> levels) {
  std::vector<uint8_t> bytes((levels.size() + levels_a_byte - 1) / levels_a_byte);
  for (size_t i = 0; i < levels.size(); ++i)
    bytes[i / levels_a_byte] |= static_cast<uint8_t>(levels[i] << (4 * (i % levels_a_byte)));
  return bytes;
}

surface::TwoCoverages RemovedBone::sample_at(const Vec3i& voxel) const {
  if (!grid_.contains(voxel)) return {};
  const size_t index = grid_.index(voxel);
  const uint8_t* before = kept(static_cast<uint32_t>(index / voxel::brick_voxels));
  return {before == nullptr ? now_[index] : before[index % voxel::brick_voxels], now_[index]};
}

}  // namespace ream::stream
