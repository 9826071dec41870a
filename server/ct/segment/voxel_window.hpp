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

/// The box of the set voxels; dims zero when there are none.
inline VoxelWindow window_of_set(const std::vector<uint8_t>& mask, const Vec3i& dims) {
  Vec3i low = dims, high = -Vec3i::Ones();
  size_t i = 0;
  for (int w = 0; w < dims.z(); ++w)
    for (int v = 0; v < dims.y(); ++v)
      for (int u = 0; u < dims.x(); ++u, ++i)
        if (mask[i] != 0) low = low.cwiseMin(Vec3i(u, v, w)), high = high.cwiseMax(Vec3i(u, v, w));
  if (high.x() < 0) return {};
  return {low, high - low + Vec3i::Ones()};
}

/// With `margin_mm` more on every side, as far as the volume goes.
inline VoxelWindow widened(const VoxelWindow& window, const Vec3i& dims, const Vec3& spacing_mm,
                           double margin_mm) {
  const Vec3i margin = (margin_mm / spacing_mm.array()).ceil().cast<int>().matrix();
  const Vec3i low = (window.low - margin).cwiseMax(0);
  const Vec3i end = (window.low + window.dims + margin).cwiseMin(dims);
  return {low, end - low};
}

/// What both hold; a side may be negative when they do not meet.
inline VoxelWindow common(const VoxelWindow& a, const VoxelWindow& b) {
  const Vec3i low = a.low.cwiseMax(b.low);
  return {low, (a.low + a.dims).cwiseMin(b.low + b.dims) - low};
}

/// Copies what two windows of one volume share.
template <typename T>
void copy_common(const std::vector<T>& from, const VoxelWindow& from_window, std::vector<T>& to,
                 const VoxelWindow& to_window) {
  const VoxelWindow shared = common(from_window, to_window);
  if ((shared.dims.array() <= 0).any()) return;
  put_back(to, to_window.dims, {shared.low - to_window.low, shared.dims},
           cut_out(from, from_window.dims, {shared.low - from_window.low, shared.dims}));
}

}  // namespace ream::ct
