#pragma once
#include <cstddef>
#include <optional>

#include "ct/hu_volume.hpp"
#include "geometry/vec.hpp"

namespace ream::ct {

/// One byte per voxel of a volume: 1 bone, 0 not.
using Mask = std::vector<uint8_t>;

/// Voxels of at least `threshold_hu`.
Mask above_threshold(const HuVolume& volume, double threshold_hu);

/// What is reached from `seed` through set voxels over common faces (6-connected): two parts that meet only
/// along an edge or at a corner stay apart. Needs a seed inside the dims; empty mask when the seed is not
/// set.
Mask grown_from(const Mask& mask, const Vec3i& dims, const Vec3i& seed);

/// The 6-connected part with the most voxels; on a tie the one with the lowest index.
Mask largest_part(const Mask& mask, const Vec3i& dims);

/// Sets the voids that no face-connected path of unset voxels joins to the border of the volume. Across an
/// axis of one voxel there is no border: a single slice is filled in its plane.
void fill_voids(Mask& mask, const Vec3i& dims);

/// Fills what is enclosed within slices across at least `min_axes` of the three voxel axes: marrow whose
/// wall has a pore somewhere, which is no closed void in space.
void fill_marrow(Mask& mask, const Vec3i& dims, int min_axes = 2);

/// The set voxel nearest to `world_mm`, within `reach_mm`; empty when there is none.
std::optional<Vec3i> nearest_set(const Mask& mask, const HuVolume& volume, const Vec3& world_mm,
                                 double reach_mm);

size_t count_set(const Mask& mask);

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
