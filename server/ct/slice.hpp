#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "geometry/vec.hpp"

namespace ream::ct {

/// One slice of a volume across a voxel axis (0 u, 1 v, 2 w), rows of the lower remaining axis first: across
/// w it is nx * ny with x fastest, across v nx * nz with x fastest, across u ny * nz with y fastest. Needs an
/// index within the dims.
template <typename T>
std::vector<T> slice_of(std::span<const T> voxels, const Vec3i& dims, int axis, int index) {
  const auto nx = static_cast<size_t>(dims.x()), ny = static_cast<size_t>(dims.y()),
             nz = static_cast<size_t>(dims.z());
  const size_t step[3] = {1, nx, nx * ny}, count[3] = {nx, ny, nz};
  const size_t across = axis == 0 ? 1 : 0, down = axis == 2 ? 1 : 2;
  const size_t first = static_cast<size_t>(index) * step[axis];
  std::vector<T> slice;
  slice.reserve(count[across] * count[down]);
  for (size_t row = 0; row < count[down]; ++row)
    for (size_t i = 0; i < count[across]; ++i)
      slice.push_back(voxels[first + row * step[down] + i * step[across]]);
  return slice;
}

}  // namespace ream::ct
