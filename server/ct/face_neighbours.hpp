#pragma once
#include <cstddef>

#include "geometry/vec.hpp"

namespace ream::ct {

/// Sides of a volume, to find neighbours of a voxel by its place in memory (x fastest).
struct Steps {
  size_t nx, ny, nz;
  explicit Steps(const Vec3i& dims)
      : nx(static_cast<size_t>(dims.x())),
        ny(static_cast<size_t>(dims.y())),
        nz(static_cast<size_t>(dims.z())) {}
};

/// Visits the up to six face neighbours of voxel `i`.
template <typename Visit>
void each_face_neighbour(const Steps& s, size_t i, Visit&& visit) {
  const size_t u = i % s.nx, v = (i / s.nx) % s.ny, w = i / (s.nx * s.ny);
  if (u > 0) visit(i - 1);
  if (u + 1 < s.nx) visit(i + 1);
  if (v > 0) visit(i - s.nx);
  if (v + 1 < s.ny) visit(i + s.nx);
  if (w > 0) visit(i - s.nx * s.ny);
  if (w + 1 < s.nz) visit(i + s.nx * s.ny);
}

}  // namespace ream::ct
