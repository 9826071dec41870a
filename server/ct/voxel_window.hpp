#pragma once
#include <algorithm>
#include <vector>

#include "geometry/vec.hpp"

namespace ream::ct {

/// Part of a volume: voxels from `low`, `dims` of them.
struct VoxelWindow {
  Vec3i low = Vec3i::Zero(), dims = Vec3i::Zero();
};

/// Calls visit(place in the volume, place in the window, count) for each row of the window; x fastest in
/// both.
template <typename Visit>
void each_row(const VoxelWindow& window, const Vec3i& volume_dims, Visit&& visit) {
  const auto nx = static_cast<size_t>(volume_dims.x()), ny = static_cast<size_t>(volume_dims.y());
  const auto count = static_cast<size_t>(window.dims.x());
  size_t within = 0;
  for (int w = 0; w < window.dims.z(); ++w)
    for (int v = 0; v < window.dims.y(); ++v, within += count)
      visit(static_cast<size_t>(window.low.x()) +
                nx * (static_cast<size_t>(window.low.y() + v) + ny * static_cast<size_t>(window.low.z() + w)),
            within, count);
}

template <typename T>
std::vector<T> cut_out(const std::vector<T>& values, const Vec3i& volume_dims, const VoxelWindow& window) {
  std::vector<T> result(static_cast<size_t>(window.dims.x()) * static_cast<size_t>(window.dims.y()) *
                        static_cast<size_t>(window.dims.z()));
  each_row(window, volume_dims, [&](size_t from, size_t to, size_t count) {
    std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(from), count,
                result.begin() + static_cast<std::ptrdiff_t>(to));
  });
  return result;
}

template <typename T>
void put_back(std::vector<T>& values, const Vec3i& volume_dims, const VoxelWindow& window,
              const std::vector<T>& part) {
  each_row(window, volume_dims, [&](size_t to, size_t from, size_t count) {
    std::copy_n(part.begin() + static_cast<std::ptrdiff_t>(from), count,
                values.begin() + static_cast<std::ptrdiff_t>(to));
  });
}

}  // namespace ream::ct
