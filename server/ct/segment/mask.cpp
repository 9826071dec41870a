#include "ct/segment/mask.hpp"

#include <algorithm>

#include "ct/segment/voxel_window.hpp"

namespace ream::ct {
namespace {

/// Turns every voxel of value `from` that is face-connected to the pending ones into `to`; returns how many.
size_t flood(Mask& mask, const Steps& steps, std::vector<size_t> pending, uint8_t from, uint8_t to) {
  size_t count = pending.size();
  for (const size_t i : pending) mask[i] = to;
  while (!pending.empty()) {
    const size_t i = pending.back();
    pending.pop_back();
    each_face_neighbour(steps, i, [&](size_t n) {
      if (mask[n] != from) return;
      mask[n] = to;
      ++count;
      pending.push_back(n);
    });
  }
  return count;
}

void keep_only(Mask& mask, uint8_t value) {
  for (uint8_t& m : mask) m = m == value;
}

}  // namespace

Mask above_threshold(const HuVolume& volume, double threshold_hu) {
  Mask mask(volume.hu.size());
  for (size_t i = 0; i < mask.size(); ++i) mask[i] = volume.hu[i] >= threshold_hu;
  return mask;
}

Mask grown_from(const Mask& mask, const Vec3i& dims, const Vec3i& seed) {
  const Steps steps(dims);
  const size_t start = static_cast<size_t>(seed.x()) +
                       steps.nx * (static_cast<size_t>(seed.y()) + steps.ny * static_cast<size_t>(seed.z()));
  Mask result = mask;
  if (result[start] == 1) flood(result, steps, {start}, 1, 2);
  keep_only(result, 2);
  return result;
}

Mask largest_part(const Mask& mask, const Vec3i& dims) {
  const Steps steps(dims);
  Mask visited = mask;
  size_t best_start = 0, best_count = 0;
  for (size_t i = 0; i < visited.size(); ++i) {
    if (visited[i] != 1) continue;
    const size_t count = flood(visited, steps, {i}, 1, 2);
    if (count > best_count) best_count = count, best_start = i;
  }
  Mask result = mask;
  if (best_count > 0) flood(result, steps, {best_start}, 1, 2);
  keep_only(result, 2);
  return result;
}

void fill_voids(Mask& mask, const Vec3i& dims) {
  const Steps steps(dims);
  std::vector<size_t> border;
  for (size_t i = 0; i < mask.size(); ++i) {
    const size_t u = i % steps.nx, v = (i / steps.nx) % steps.ny, w = i / (steps.nx * steps.ny);
    const auto at_end = [](size_t place, size_t count) {
      return count > 1 && (place == 0 || place + 1 == count);
    };
    const bool edge = at_end(u, steps.nx) || at_end(v, steps.ny) || at_end(w, steps.nz);
    if (edge && mask[i] == 0) border.push_back(i);
  }
  flood(mask, steps, std::move(border), 0, 2);
  for (uint8_t& m : mask) m = m != 2;
}

void fill_marrow(Mask& bone, const Vec3i& dims, int min_axes) {
  Mask closed_across(bone.size());
  for (int axis = 0; axis < 3; ++axis)
    for (int slice = 0; slice < dims[axis]; ++slice) {
      VoxelWindow window{Vec3i::Zero(), dims};
      window.low[axis] = slice;
      window.dims[axis] = 1;
      Mask plane = cut_out(bone, dims, window);
      const Mask before = plane;
      fill_voids(plane, window.dims);
      Mask sums = cut_out(closed_across, dims, window);
      for (size_t i = 0; i < plane.size(); ++i)
        sums[i] = static_cast<uint8_t>(sums[i] + (plane[i] && !before[i]));
      put_back(closed_across, dims, window, sums);
    }
  for (size_t i = 0; i < bone.size(); ++i)
    if (closed_across[i] >= min_axes) bone[i] = 1;
}

std::optional<Vec3i> nearest_set(const Mask& mask, const HuVolume& volume, const Vec3& world_mm,
                                 double reach_mm) {
  const Vec3i centre = volume.voxel_at_world(world_mm);
  const Vec3i reach = (reach_mm / volume.spacing_mm.array()).ceil().cast<int>().matrix();
  const Vec3i low = (centre - reach).cwiseMax(0),
              high = (centre + reach).cwiseMin((volume.dims.array() - 1).matrix());
  std::optional<Vec3i> best;
  double best_distance = reach_mm;
  for (int w = low.z(); w <= high.z(); ++w)
    for (int v = low.y(); v <= high.y(); ++v)
      for (int u = low.x(); u <= high.x(); ++u) {
        if (mask[volume.index(u, v, w)] == 0) continue;
        const Vec3i o(u, v, w);
        const double distance = o == centre ? 0.0 : (volume.world_of_centre(o) - world_mm).norm();
        if (distance > best_distance || (best && distance == best_distance)) continue;
        best = o, best_distance = distance;
      }
  return best;
}

size_t count_set(const Mask& mask) {
  return static_cast<size_t>(std::count(mask.begin(), mask.end(), uint8_t{1}));
}

}  // namespace ream::ct
