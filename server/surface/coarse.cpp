#include "surface/coarse.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

namespace ream::surface {
namespace {

using voxel::brick_edge;
using voxel::brick_voxels;

constexpr uint8_t filled = 128;

/// Mean and fullest voxel of the samples of a region, one sample wider on all sides than what is asked for.
struct Region {
  Vec3i first;  ///< sample
  int edge;
  std::vector<uint8_t> mean, peak;

  Region(const Vec3i& first_sample, int samples) : first(first_sample), edge(samples) {
    mean.resize(static_cast<size_t>(edge) * static_cast<size_t>(edge) * static_cast<size_t>(edge));
    peak.resize(mean.size());
  }
  int index(const Vec3i& sample) const {
    const Vec3i o = sample - first;
    return o.x() + edge * (o.y() + edge * o.z());
  }
};

struct Sample {
  uint8_t mean, peak;
};

template <int stride>
Sample sample_of(const uint8_t* voxels) {
  constexpr int count = stride * stride * stride;
  int sum = 0;
  uint8_t peak = 0;
  for (int w = 0; w < stride; ++w)
    for (int v = 0; v < stride; ++v)
      for (int u = 0; u < stride; ++u) {
        const uint8_t c = voxels[(w * brick_edge + v) * brick_edge + u];
        sum += c;
        peak = std::max(peak, c);
      }
  return {static_cast<uint8_t>((sum + count / 2) / count), peak};
}

bool uniform(const uint8_t* brick) { return std::memcmp(brick, brick + 1, brick_voxels - 1) == 0; }

template <int stride>
void add_brick(const uint8_t* voxels, const Vec3i& brick, Region& region) {
  constexpr int samples = brick_edge / stride;
  const bool same = uniform(voxels);
  const Vec3i origin = brick * samples;
  const Vec3i low = region.first.cwiseMax(origin) - origin;
  const Vec3i high = (region.first.array() + region.edge).min(origin.array() + samples).matrix() - origin;
  for (int z = low.z(); z < high.z(); ++z)
    for (int y = low.y(); y < high.y(); ++y) {
      auto i = static_cast<size_t>(region.index(origin + Vec3i(low.x(), y, z)));
      for (int x = low.x(); x < high.x(); ++x, ++i) {
        const Sample s = same ? Sample{voxels[0], voxels[0]}
                              : sample_of<stride>(voxels + ((z * brick_edge + y) * brick_edge + x) * stride);
        region.mean[i] = s.mean;
        region.peak[i] = s.peak;
      }
    }
}

template <int stride>
void fill(const voxel::VoxelGrid& grid, const uint8_t* coverage, Region& region) {
  constexpr int samples = brick_edge / stride;
  const Vec3i low = region.first.cwiseMax(0) / samples;
  const Vec3i last = (region.first.array() + (region.edge - 1)).matrix() / samples;
  const Vec3i high = last.cwiseMin(grid.brick_dims() - Vec3i::Ones());
  for (int z = low.z(); z <= high.z(); ++z)
    for (int y = low.y(); y <= high.y(); ++y)
      for (int x = low.x(); x <= high.x(); ++x) {
        const Vec3i brick(x, y, z);
        add_brick<stride>(coverage + grid.brick_base(grid.brick_index(brick)), brick, region);
      }
}

bool has_filled_neighbour(const Region& region, int i) {
  const int row = region.edge, slice = row * row;
  for (int z = -slice; z <= slice; z += slice)
    for (int y = -row; y <= row; y += row)
      for (int x = -1; x <= 1; ++x)
        if (region.mean[static_cast<size_t>(i + z + y + x)] >= filled) return true;
  return false;
}

}  // namespace

void coarse_samples(const voxel::VoxelGrid& grid, const uint8_t* coverage, const Vec3i& block_first, int edge,
                    int stride, uint8_t* samples, int row_bytes, int slice_bytes) {
  Region region(block_first.array() - 3, edge + 2);
  if (stride == 2)
    fill<2>(grid, coverage, region);
  else
    fill<4>(grid, coverage, region);
  for (int z = 0; z < edge; ++z)
    for (int y = 0; y < edge; ++y) {
      uint8_t* to = samples + z * slice_bytes + y * row_bytes;
      int i = 1 + region.edge * (y + 1 + region.edge * (z + 1));
      for (int x = 0; x < edge; ++x, ++i) {
        const uint8_t mean = region.mean[static_cast<size_t>(i)], peak = region.peak[static_cast<size_t>(i)];
        const bool thin_wall = mean < filled && peak >= filled && !has_filled_neighbour(region, i);
        to[x] = thin_wall ? peak : mean;
      }
    }
}

}  // namespace ream::surface
