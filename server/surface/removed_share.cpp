#include "surface/removed_share.hpp"

#include <cmath>

namespace ream::surface {

std::vector<float> removed_shares(std::span<const Vec3f> points_mm, const voxel::VoxelGrid& grid,
                                  const uint8_t* before, const uint8_t* now) {
  constexpr int max_level = 255;
  const auto sample = [&](const Vec3i& voxel) {
    if (!grid.contains(voxel)) return TwoCoverages{};
    const size_t index = grid.index(voxel);
    return TwoCoverages{before[index], now[index]};
  };
  std::vector<float> shares;
  shares.reserve(points_mm.size());
  for (const Vec3f& point : points_mm) {
    std::array<int64_t, 3> at;
    for (int axis = 0; axis < 3; ++axis)
      at[static_cast<size_t>(axis)] = std::llround(point[axis] / grid.spacing_mm[axis] * units_per_voxel);
    shares.push_back(static_cast<float>(removed_level(at, max_level, sample)) / max_level);
  }
  return shares;
}

}  // namespace ream::surface
