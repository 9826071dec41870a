#include "collide/contact_schedule.hpp"

#include <algorithm>

#include "collide/cull_blocks.hpp"
#include "core/vector_clones.hpp"

namespace ream::collide {
namespace {

/// Readings are kept as floats below this many voxels, where they are exact to 1/2048.
constexpr double rebase_at_voxels = 4096.0;
/// For the rounding of readings and of the places.
constexpr float reading_slack_voxels = 1.0f / 512.0f;

constexpr size_t blocks_at_once = 256;

/// late[i] = 1 where a block is due.
REAM_VECTOR_CLONES void find_late(const float* __restrict due_at, float now, int n,
                                  int32_t* __restrict late) {
  for (int i = 0; i < n; ++i) late[i] = due_at[i] <= now ? 1 : 0;
}

}  // namespace

ContactSchedule::ContactSchedule(const NarrowPhaseInput& input)
    : in_(input),
      odometer_(input.shell.bounds_mm, input.bone.grid.min_spacing_mm()),
      due_at_(input.shell.blocks.size(), 0.0f),
      list_(input.shell.blocks.size()) {}

std::span<const SurvivingBlock> ContactSchedule::due(const QuantisedPose& grid_from_tool, const Voi& voi,
                                                     const VoxelTransform& transform) noexcept {
  odometer_.advance(dequantised(grid_from_tool));
  if (odometer_.voxels() >= rebase_at_voxels) {
    const auto by = static_cast<float>(odometer_.voxels());
    for (float& at : due_at_) at = std::max(0.0f, at - by);
    odometer_.rebase(odometer_.voxels());
  }
  const auto now = static_cast<float>(odometer_.voxels());
  const Culling culling(in_, voi, grid_from_tool);
  count_ = 0;
  for (size_t first = 0; first < due_at_.size(); first += blocks_at_once) {
    int32_t late[blocks_at_once];
    const size_t n = std::min(blocks_at_once, due_at_.size() - first);
    find_late(due_at_.data() + first, now + reading_slack_voxels, static_cast<int>(n), late);
    for (size_t i = 0; i < n; ++i) {
      if (!late[i]) continue;
      const auto block = static_cast<uint32_t>(first + i);
      const float gap = culling.gap_voxels(in_.shell, block);
      if (gap > 0.0f)
        due_at_[block] = now + gap;
      else
        list_[count_++] = {block, transform.base(in_.shell.blocks[block].origin_units)};
    }
  }
  return {list_.data(), count_};
}

void ContactSchedule::measure(const ContactView& view, IsClear clear, const SurvivingBlock& at) noexcept {
  for (const Clearance clearance : {Clearance::brick, Clearance::cell, Clearance::voxel})
    if (clear(view, at, clearance)) {
      due_at_[at.block] = static_cast<float>(odometer_.voxels()) + clearance_voxels(clearance);
      return;
    }
}

}  // namespace ream::collide
