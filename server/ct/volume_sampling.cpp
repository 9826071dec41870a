#include "ct/volume_sampling.hpp"

#include <algorithm>
#include <cmath>

namespace ream::ct {
namespace {

/// Mean of every three along one axis: `count` values, `stride` apart, `lines` times from each start.
void blur_line(float* first, size_t count, size_t stride) {
  float before = 0.0F, here = first[0];
  for (size_t i = 0; i < count; ++i) {
    const float after = i + 1 < count ? first[(i + 1) * stride] : 0.0F;
    first[i * stride] = (before + here + after) / 3.0F;
    before = here;
    here = after;
  }
}

}  // namespace

double hu_at_world(const HuVolume& volume, const Vec3& world_mm) {
  const Pose& pose = volume.world_from_volume;
  const Vec3 p = pose.rotation.transpose() * (world_mm - pose.translation_mm);
  const Vec3 at = (p.array() / volume.spacing_mm.array() - 0.5).matrix();
  size_t low[3], high[3];
  double part[3];
  for (int axis = 0; axis < 3; ++axis) {
    const double last = volume.dims[axis] - 1, clamped = std::clamp(at[axis], 0.0, last);
    const double base = std::floor(clamped);
    low[axis] = static_cast<size_t>(base);
    high[axis] = static_cast<size_t>(std::min(base + 1.0, last));
    part[axis] = clamped - base;
  }
  const auto nx = static_cast<size_t>(volume.dims.x()), ny = static_cast<size_t>(volume.dims.y());
  const auto hu = [&](size_t u, size_t v, size_t w) {
    return static_cast<double>(volume.hu[u + nx * (v + ny * w)]);
  };
  const auto row = [&](size_t v, size_t w) {
    return hu(low[0], v, w) * (1.0 - part[0]) + hu(high[0], v, w) * part[0];
  };
  const auto slice = [&](size_t w) { return row(low[1], w) * (1.0 - part[1]) + row(high[1], w) * part[1]; };
  return slice(low[2]) * (1.0 - part[2]) + slice(high[2]) * part[2];
}

HuVolume coarsened(const HuVolume& volume, double size_mm) {
  Vec3i block;
  HuVolume coarse;
  coarse.world_from_volume = volume.world_from_volume;
  for (int axis = 0; axis < 3; ++axis) {
    const double fitting = std::floor(size_mm / volume.spacing_mm[axis] + 0.5);
    block[axis] = static_cast<int>(std::clamp(fitting, 1.0, static_cast<double>(volume.dims[axis])));
    coarse.dims[axis] = volume.dims[axis] / block[axis];
    coarse.spacing_mm[axis] = volume.spacing_mm[axis] * block[axis];
  }
  std::vector<int64_t> sums(coarse.voxel_count());
  const Vec3i used = coarse.dims.cwiseProduct(block);
  for (int w = 0; w < used.z(); ++w)
    for (int v = 0; v < used.y(); ++v) {
      const int16_t* row = volume.hu.data() + volume.index(0, v, w);
      int64_t* sum = sums.data() + coarse.index(0, v / block.y(), w / block.z());
      for (int u = 0; u < coarse.dims.x(); ++u, ++sum)
        for (int i = 0; i < block.x(); ++i) *sum += *row++;
    }
  const int64_t count = int64_t{block.x()} * block.y() * block.z();
  coarse.hu.resize(sums.size());
  std::transform(sums.begin(), sums.end(), coarse.hu.begin(),
                 [&](int64_t sum) { return static_cast<int16_t>(sum / count); });
  return coarse;
}

Vec3 gradient_hu_mm(const HuVolume& volume, const Vec3i& o) {
  Vec3 gradient = Vec3::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    Vec3i before = o, after = o;
    --before[axis], ++after[axis];
    if (!volume.contains(before) || !volume.contains(after)) continue;
    const int difference = volume.hu[volume.index(after.x(), after.y(), after.z())] -
                           volume.hu[volume.index(before.x(), before.y(), before.z())];
    gradient[axis] = difference / (2.0 * volume.spacing_mm[axis]);
  }
  return gradient;
}

void blur(std::vector<float>& values, const Vec3i& dims) {
  const auto nx = static_cast<size_t>(dims.x()), ny = static_cast<size_t>(dims.y()),
             nz = static_cast<size_t>(dims.z());
  for (size_t i = 0; i < ny * nz; ++i) blur_line(values.data() + i * nx, nx, 1);
  for (size_t w = 0; w < nz; ++w)
    for (size_t u = 0; u < nx; ++u) blur_line(values.data() + w * nx * ny + u, ny, nx);
  for (size_t i = 0; i < nx * ny; ++i) blur_line(values.data() + i, nz, nx * ny);
}

}  // namespace ream::ct
