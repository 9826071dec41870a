#include "surface/block_volume.hpp"

#include <cstring>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include "surface/brick_fill.hpp"
#include "surface/coarse.hpp"

namespace ream::surface {
namespace {

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
      const uint64_t filled = top_bits(row(y, z));
      filled_[static_cast<size_t>(z * edge + y)] = filled;
      any |= filled & corners;
      all &= filled;
    }
  return any != 0 && all != corners;
}

}  // namespace ream::surface
