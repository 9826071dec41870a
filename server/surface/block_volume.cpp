#include "surface/block_volume.hpp"

#include <algorithm>
#include <cstring>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include "surface/block_layout.hpp"
namespace ream::surface {
namespace {

using voxel::brick_edge;
using voxel::brick_voxels;

constexpr uint8_t filled_level = 128;

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
        if (region.mean[static_cast<size_t>(i + z + y + x)] >= filled_level) return true;
  return false;
}

using voxel::brick_edge;
static_assert(BlockVolume::margin_x == brick_edge && BlockVolume::row_bytes == 48);

/// Bit i is the top bit of byte i of a row: set where coverage is 128 or more.
uint64_t top_bits(const uint8_t* row) {
  uint64_t result = 0;
#ifdef __SSE2__
  for (int i = 0; i < BlockVolume::row_bytes; i += 16) {
    const __m128i bytes = _mm_loadu_si128(reinterpret_cast<const __m128i*>(row + i));
    result |= static_cast<uint64_t>(static_cast<unsigned>(_mm_movemask_epi8(bytes))) << i;
  }
#else
  for (int i = 0; i < BlockVolume::row_bytes; i += 8) {
    uint64_t word;
    std::memcpy(&word, row + i, 8);
    result |= (((word >> 7) & 0x0101010101010101ull) * 0x0102040810204080ull >> 56) << i;
  }
#endif
  return result;
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
        const bool thin_wall =
            mean < filled_level && peak >= filled_level && !has_filled_neighbour(region, i);
        to[x] = thin_wall ? peak : mean;
      }
    }
}

BlockVolume::BlockVolume(const voxel::VoxelGrid& grid, int stride)
    : grid_(grid),
      stride_(stride),
      samples_(static_cast<size_t>(slice_bytes) * edge),
      filled_(static_cast<size_t>(edge) * edge) {}

bool BlockVolume::load(const uint8_t* coverage, const Vec3i& block) {
  const Vec3i first(margin_x, margin, margin);
  low_ = (block.array() == 0).select(first.array() - 1, first.array());
  last_ = first.array() + cells();
  const auto fill_at = [&](uint32_t brick) {
    return fill_of(coverage + size_t{brick} * voxel::brick_voxels);
  };
  if (!may_hold_surface(grid_, block, fill_at)) return false;
  if (stride_ == 1)
    load_voxels(coverage, block);
  else
    load_coarse(coverage, block);
  return find_filled();
}

void BlockVolume::load_voxels(const uint8_t* coverage, const Vec3i& block) {
  constexpr int bricks = block_edge / brick_edge;
  const Vec3i brick_dims = grid_.brick_dims();
  const auto rows = [](int brick) {  // of a brick beside, or one of, the block's: first and last
    return std::array<int, 2>{brick < 0 ? brick_edge - margin : 0,
                              brick < bricks ? brick_edge - 1 : margin - 1};
  };
  for (int bz = -1; bz <= bricks; ++bz)
    for (int by = -1; by <= bricks; ++by)
      for (int bx = -1; bx <= bricks; ++bx) {
        const Vec3i brick = block * bricks + Vec3i(bx, by, bz);
        const bool inside = (brick.array() >= 0).all() && (brick.array() < brick_dims.array()).all();
        const uint8_t* from = inside ? coverage + grid_.brick_base(grid_.brick_index(brick)) : nullptr;
        const auto [first_y, last_y] = rows(by);
        const auto [first_z, last_z] = rows(bz);
        for (int w = first_z; w <= last_z; ++w)
          for (int v = first_y; v <= last_y; ++v) {
            uint8_t* to = samples_.data() + (bz * brick_edge + w + margin) * slice_bytes +
                          (by * brick_edge + v + margin) * row_bytes + (bx + 1) * brick_edge;
            if (inside)
              std::memcpy(to, from + (w * brick_edge + v) * brick_edge, brick_edge);
            else
              std::memset(to, 0, brick_edge);
          }
      }
}

void BlockVolume::load_coarse(const uint8_t* coverage, const Vec3i& block) {
  coarse_samples(grid_, coverage, block * cells(), cells() + 2 * margin, stride_,
                 samples_.data() + margin_x - margin, row_bytes, slice_bytes);
}

bool BlockVolume::find_filled() {
  const uint64_t corners = bits(low_.x(), last_.x());
  uint64_t any = 0, all = corners;
  for (int z = low_.z(); z <= last_.z(); ++z)
    for (int y = low_.y(); y <= last_.y(); ++y) {
      const uint64_t filled_level = top_bits(row(y, z));
      filled_[static_cast<size_t>(z * edge + y)] = filled_level;
      any |= filled_level & corners;
      all &= filled_level;
    }
  return any != 0 && all != corners;
}

}  // namespace ream::surface
