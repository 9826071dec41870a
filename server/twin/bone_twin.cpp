#include "twin/bone_twin.hpp"

#include <array>
#include <cassert>
#include <span>
#include <utility>

#include "core/hash.hpp"
#include "record/session_hash.hpp"

namespace ream::twin {

using voxel::brick_edge;

BoneTwin::Reaming::Reaming(shell::SweptProfile of_tool, voxel::BoneModel& bone)
    : profile(std::move(of_tool)),
      schedule(profile, bone),
      removal(collide::make_removal_cpu({profile, bone})) {}

BoneTwin::BoneTwin(voxel::BoneModel bone)
    : bone_(std::move(bone)), extractor_(bone_.grid), block_changed_(extractor_.layout().count(), 1) {}

void BoneTwin::begin_segment(shell::SweptProfile profile) {
  reaming_ = std::make_unique<Reaming>(std::move(profile), bone_);
}

uint64_t BoneTwin::step(const CauseTick& cause) noexcept {
  assert(reaming_);
  if ((cause.flags & record::cutting_flag) != 0)
    cut(cause.grid_from_tool);
  else
    reaming_->schedule.pass(cause.grid_from_tool);
  session_hash_ = record::hash_after(session_hash_, cause.tick, cause.flags, cause.grid_from_tool);
  return session_hash_;
}

/// As sim::remove_bone folds it into the hash.
void BoneTwin::cut(const QuantisedPose& grid_from_tool) noexcept {
  collide::RemovalSums sums;
  std::array<collide::BrickOutcome, collide::RemovalSchedule::max_bricks_per_tick> outcomes;
  collide::cut_due(
      reaming_->schedule, grid_from_tool, outcomes,
      [&](std::span<const uint32_t> due) {
        return reaming_->removal->cut(grid_from_tool, due, outcomes, sums);
      },
      [this](uint32_t brick) { note_change(brick); });
  if (sums.changed_bricks != 0) session_hash_ = hash_combine(session_hash_, sums.change_hash);
}

void BoneTwin::note_change(uint32_t brick) noexcept {
  const Vec3i low = bone_.grid.brick_coordinates(brick) * brick_edge;
  const surface::BlockLayout& layout = extractor_.layout();
  surface::for_each_block(layout,
                          surface::blocks_touched(layout, low, (low.array() + (brick_edge - 1)).matrix(), 1),
                          [this](uint32_t block) { block_changed_[block] = 1; });
}

std::vector<uint32_t> BoneTwin::take_changed_blocks() {
  std::vector<uint32_t> blocks;
  for (uint32_t block = 0; block < block_changed_.size(); ++block)
    if (std::exchange(block_changed_[block], uint8_t{0}) != 0) blocks.push_back(block);
  return blocks;
}

surface::BlockMesh BoneTwin::surface_of(uint32_t block) {
  return extractor_.extract(bone_.coverage.data(), block);
}

}  // namespace ream::twin
