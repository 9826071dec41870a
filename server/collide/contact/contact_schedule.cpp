#include "collide/contact/contact_schedule.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "collide/contact/broad_phase.hpp"
#include "core/vector_clones.hpp"

namespace ream::collide {
namespace {

/// Readings are kept as floats below this many voxels, where they are exact to 1/2048.
constexpr double rebase_at_voxels = 4096.0;
/// For the rounding of readings and of the places.
constexpr float slack_voxels = 1.0f / 512.0f;
constexpr float never = 1e30f;

/// Chunks measured a look: so many, and one more for every so many that are due, which bounds the work of a
/// tick that finds many of them free. Others are merely visited again.
constexpr size_t min_measures = 24, due_a_measure = 32;
/// Of the free chunks at most one in so many: those that stay near would be measured in vain.
constexpr size_t measured_share = 4;
/// A measure costs as much as a few visits: it is made where it is likely to save more.
constexpr float worthwhile_looks = 4.0f;

/// late[i] = 1 where a block has a chunk that is due.
REAM_VECTOR_CLONES void find_late(const float* __restrict due_at, float now, size_t n,
                                  uint8_t* __restrict late) {
  for (size_t i = 0; i < n; ++i) late[i] = due_at[i] <= now ? 1 : 0;
}

}  // namespace

ContactSchedule::ContactSchedule(const NarrowPhaseInput& input)
    : in_(input),
      odometer_(input.shell.bounds_mm, input.bone.grid.min_spacing_mm()),
      chunk_due_at_(input.shell.chunk_count(), 0.0f),
      block_due_at_(input.shell.blocks.size(), 0.0f),
      gap_due_at_(input.shell.blocks.size(), 0.0f),
      late_((input.shell.blocks.size() + 7) / 8 * 8, 0),
      list_(input.shell.chunk_count()) {}

std::span<const DueChunk> ContactSchedule::due(const QuantisedPose& grid_from_tool, const Voi& voi,
                                               const VoxelTransform& transform) noexcept {
  const double before = odometer_.voxels();
  moved_voxels_ = static_cast<float>(odometer_.advance(dequantised(grid_from_tool)) - before);
  if (odometer_.voxels() >= rebase_at_voxels) rebase();
  const auto now = static_cast<float>(odometer_.voxels());
  const Culling culling(in_.distance, in_.bone.grid, voi, grid_from_tool);
  count_ = 0;
  find_late(block_due_at_.data(), now + slack_voxels, block_due_at_.size(), late_.data());
  for (size_t first = 0; first < late_.size(); first += 8) {
    // Eight flags at once; most are clear.
    uint64_t flags;
    std::memcpy(&flags, late_.data() + first, sizeof flags);
    for (; flags != 0; flags &= flags - 1)
      list_block(static_cast<uint32_t>(first) + static_cast<uint32_t>(std::countr_zero(flags)) / 8, now,
                 culling, transform);
  }
  return {list_.data(), count_};
}

void ContactSchedule::list_block(uint32_t number, float now, const Culling& culling,
                                 const VoxelTransform& transform) noexcept {
  const ContactBlock& block = in_.shell.blocks[number];
  const uint32_t first_chunk = in_.shell.first_chunks[number], end = in_.shell.first_chunks[number + 1];
  if (gap_due_at_[number] <= now) {
    const float gap = culling.gap_voxels(in_.shell, number);
    // A sphere that reaches into the bone by so much reaches into it until it has come out by as much.
    gap_due_at_[number] = now + std::abs(gap);
    if (gap > 0.0f) {
      std::fill(chunk_due_at_.begin() + first_chunk, chunk_due_at_.begin() + end, now + gap);
      block_due_at_[number] = now + gap;
      return;
    }
  }
  const std::array<int32_t, 3> base = transform.base(block.origin_units);
  float next_due = never;
  for (uint32_t chunk = first_chunk; chunk < end; ++chunk) {
    next_due = std::min(next_due, chunk_due_at_[chunk]);
    if (chunk_due_at_[chunk] > now + slack_voxels) continue;
    const uint32_t before = (chunk - first_chunk) * chunk_points;
    list_[count_++] = {number, block.first + before, std::min<uint32_t>(block.count - before, chunk_points),
                       base};
  }
  block_due_at_[number] = next_due;
}

void ContactSchedule::rebase() noexcept {
  const auto by = static_cast<float>(odometer_.voxels());
  for (auto* readings : {&chunk_due_at_, &block_due_at_, &gap_due_at_})
    for (float& at : *readings) at = std::max(0.0f, at - by);
  odometer_.rebase(odometer_.voxels());
}

void ContactSchedule::visited(const ContactView& view, IsClear is_clear,
                              std::span<const uint8_t> touched) noexcept {
  if (!worth_measuring(Clearance::brick)) return;
  const auto of_due = touched.first(count_);
  const size_t free = count_ - static_cast<size_t>(std::count(of_due.begin(), of_due.end(), uint8_t{1}));
  const size_t most =
      std::min(min_measures + count_ / due_a_measure, (free + measured_share - 1) / measured_share);
  size_t measures = 0;
  for (size_t i = 0; i < count_ && measures < most; ++i) {
    // Begin where the last look ended, so that all have their turn.
    turn_ = turn_ + 1 < count_ ? turn_ + 1 : 0;
    if (touched[turn_]) continue;
    measure(view, is_clear, list_[turn_]);
    ++measures;
  }
}

bool ContactSchedule::worth_measuring(Clearance clearance) const noexcept {
  return clearance_voxels(clearance) >= worthwhile_looks * moved_voxels_;
}

void ContactSchedule::measure(const ContactView& view, IsClear is_clear, const DueChunk& due) noexcept {
  const ContactBlock& block = in_.shell.blocks[due.block];
  const uint32_t chunk = in_.shell.first_chunks[due.block] + (due.first - block.first) / chunk_points;
  for (const Clearance clearance : {Clearance::brick, Clearance::cell})
    if (worth_measuring(clearance) && is_clear(view, due, clearance)) {
      chunk_due_at_[chunk] = static_cast<float>(odometer_.voxels()) + clearance_voxels(clearance);
      return;
    }
}

}  // namespace ream::collide
