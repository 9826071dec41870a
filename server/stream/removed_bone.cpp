#include "stream/removed_bone.hpp"

#include <algorithm>

namespace ream::stream {
namespace {

/// Coverage that is lost where a surface has gone half a voxel further in: from full to the surface's level.
constexpr int64_t whole_loss = 127;
constexpr size_t levels_a_byte = 2;

}  // namespace

RemovedBone::RemovedBone(const voxel::Replica& now)
    : now_(now), layout_(now.grid()), place_(now.grid().brick_count(), 0) {}

void RemovedBone::keep(uint32_t brick, const uint8_t* before) {
  if (place_[brick] != 0) return;
  before_.insert(before_.end(), before, before + voxel::brick_voxels);
  place_[brick] = static_cast<uint32_t>(before_.size() / voxel::brick_voxels);
}

std::vector<uint8_t> RemovedBone::levels(std::span<const surface::BlockVertex> vertices,
                                         uint32_t block) const {
  if (before_.empty()) return {};
  const Vec3i origin = layout_.coordinates(block) * surface::block_edge - Vec3i::Ones();
  std::vector<uint8_t> levels;
  levels.reserve(vertices.size());
  unsigned any = 0;
  for (const surface::BlockVertex& vertex : vertices) {
    levels.push_back(static_cast<uint8_t>(level_at(vertex, origin)));
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

/// Trilinear between voxel centres, in whole numbers. How deep a place lies under the first surface changes
/// evenly over the edge of a cut; that bone is gone there says that it was cut.
unsigned RemovedBone::level_at(const surface::BlockVertex& vertex, const Vec3i& block_origin) const {
  constexpr int unit = surface::units_per_voxel;
  const int from_centres[] = {vertex.x - unit / 2, vertex.y - unit / 2, vertex.z - unit / 2};
  Vec3i low;
  int64_t share[3][2];
  for (int axis = 0; axis < 3; ++axis) {
    const int voxels = from_centres[axis] >= 0 ? from_centres[axis] / unit : -1;
    low[axis] = block_origin[axis] + voxels;
    share[axis][1] = from_centres[axis] - voxels * unit;
    share[axis][0] = unit - share[axis][1];
  }
  int64_t before = 0, lost = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const int x = corner & 1, y = corner >> 1 & 1, z = corner >> 2;
    const Sample sample = sample_at(low + Vec3i(x, y, z));
    const int64_t weight = share[0][x] * share[1][y] * share[2][z];
    before += weight * sample.before;
    lost += weight * std::max(0, sample.before - sample.now);
  }
  constexpr int64_t one = int64_t{unit} * unit * unit;
  const int64_t depth = before - one * 255 / 2;
  return static_cast<unsigned>(
      std::clamp<int64_t>(max_level * std::min(depth, lost) / (one * whole_loss), 0, max_level));
}

RemovedBone::Sample RemovedBone::sample_at(const Vec3i& voxel) const {
  if (!now_.grid().contains(voxel)) return {};
  const size_t index = now_.grid().index(voxel);
  const uint8_t now = now_.coverage()[index];
  const uint32_t place = place_[index / voxel::brick_voxels];
  if (place == 0) return {now, now};
  return {before_[size_t{place - 1} * voxel::brick_voxels + index % voxel::brick_voxels], now};
}

}  // namespace ream::stream
