#include "collide/contact_schedule.hpp"

#include <algorithm>
#include <bit>

#include "collide/cull_blocks.hpp"
#include "core/vector_clones.hpp"

namespace ream::collide {
namespace {

/// Readings are kept as floats below this many voxels, where they are exact to 1/2048.
constexpr double rebase_at_voxels = 4096.0;
/// For the rounding of readings and of the places.
constexpr float slack_voxels = 1.0f / 512.0f;
constexpr float never = 1e30f;

/// Bit i of word k: chunk 64 k + i is due.
REAM_VECTOR_CLONES void find_late(const float* __restrict due_at, float now, size_t words,
                                  uint64_t* __restrict late) {
  for (size_t word = 0; word < words; ++word, due_at += 64) {
    uint8_t flags[64];
    for (int i = 0; i < 64; ++i) flags[i] = due_at[i] <= now ? 1 : 0;
    uint64_t bits = 0;
    for (int i = 0; i < 8; ++i) {
      uint64_t eight;
      __builtin_memcpy(&eight, flags + 8 * i, sizeof eight);
      bits |= (eight * 0x0102040810204080ull >> 56) << (8 * i);
    }
    late[word] = bits;
  }
}

}  // namespace

ContactSchedule::ContactSchedule(const NarrowPhaseInput& input)
    : in_(input),
      odometer_(input.shell.bounds_mm, input.bone.grid.min_spacing_mm()),
      due_at_((input.shell.chunk_count() + 63) / 64 * 64, never),
      late_(due_at_.size() / 64),
      list_(input.shell.chunk_count()) {
  std::fill_n(due_at_.begin(), input.shell.chunk_count(), 0.0f);
}

std::span<const DueChunk> ContactSchedule::due(const QuantisedPose& grid_from_tool, const Voi& voi,
                                               const VoxelTransform& transform) noexcept {
  odometer_.advance(dequantised(grid_from_tool));
  if (odometer_.voxels() >= rebase_at_voxels) {
    const auto by = static_cast<float>(odometer_.voxels());
    for (float& at : due_at_) at = at == never ? never : std::max(0.0f, at - by);
    odometer_.rebase(odometer_.voxels());
  }
  const auto now = static_cast<float>(odometer_.voxels());
  find_late(due_at_.data(), now + slack_voxels, late_.size(), late_.data());

  const Culling culling(in_, voi, grid_from_tool);
  const auto& blocks = in_.shell.blocks;
  const auto& first_chunks = in_.shell.first_chunks;
  uint32_t block = 0, next_block_chunk = 0;  // the block that chunks are in, and where the next one begins
  float gap = 0.0f;
  std::array<int32_t, 3> base{};
  count_ = 0;
  for (uint32_t word = 0; word < late_.size(); ++word)
    for (uint64_t bits = late_[word]; bits != 0; bits &= bits - 1) {
      const uint32_t chunk = 64 * word + static_cast<uint32_t>(std::countr_zero(bits));
      if (chunk >= next_block_chunk) {
        while (first_chunks[block + 1] <= chunk) ++block;
        next_block_chunk = first_chunks[block + 1];
        gap = culling.gap_voxels(in_.shell, block);
        base = transform.base(blocks[block].origin_units);
      }
      if (gap > 0.0f) {
        due_at_[chunk] = now + gap;
        continue;
      }
      const uint32_t before = (chunk - first_chunks[block]) * chunk_points;
      list_[count_++] = {block, blocks[block].first + before,
                         std::min<uint32_t>(blocks[block].count - before, chunk_points), base};
    }
  return {list_.data(), count_};
}

void ContactSchedule::visited(const ContactView& view, IsClear is_clear,
                              std::span<const uint8_t> touched) noexcept {
  size_t measures = 0;
  for (size_t i = 0; i < count_ && measures < measures_a_look; ++i) {
    // Begin where the last look ended, so that all have their turn.
    turn_ = turn_ + 1 < count_ ? turn_ + 1 : 0;
    if (touched[turn_]) continue;
    measure(view, is_clear, list_[turn_]);
    ++measures;
  }
}

void ContactSchedule::measure(const ContactView& view, IsClear is_clear, const DueChunk& due) noexcept {
  const ContactBlock& block = in_.shell.blocks[due.block];
  const uint32_t chunk = in_.shell.first_chunks[due.block] + (due.first - block.first) / chunk_points;
  for (const Clearance clearance : {Clearance::brick, Clearance::cell, Clearance::voxel})
    if (is_clear(view, due, clearance)) {
      due_at_[chunk] = static_cast<float>(odometer_.voxels()) + clearance_voxels(clearance);
      return;
    }
}

}  // namespace ream::collide
