#include "sim/step.hpp"

#include "core/hash.hpp"
#include "sim/state.hpp"

namespace ream::sim {
namespace {

/// Cuts what is due; state.changed holds what has changed.
bool cut_profile(State& state, const QuantisedPose& pose, collide::RemovalSums& sums) noexcept {
  state.changed_count = 0;
  return collide::cut_due(
      state.schedule, pose, state.outcomes,
      [&](std::span<const uint32_t> due) {
        return work_or_fail_over(state, [&](const Backend& backend) {
          return backend.removal->cut(pose, due, state.outcomes, sums);
        });
      },
      [&](uint32_t brick) { state.changed[state.changed_count++] = brick; });
}

/// Solid cells, followers and devices with memory of their own learn of changed bricks.
bool publish_changes(State& state, std::span<const uint32_t> changed) noexcept {
  for (const uint32_t brick : changed) {
    state.cells.set(
        brick, voxel::SolidCells::word_of(state.bone.coverage.data() + state.bone.grid.brick_base(brick)));
    if (state.brick_sender != nullptr) state.brick_sender->mark(brick);
  }
  return work_or_fail_over(state, [&](const Backend& backend) {
    return (backend.decay == nullptr || backend.decay->publish()) &&
           backend.narrow_phase->bricks_changed(changed);
  });
}

}  // namespace

bool remove_bone(State& state, const QuantisedPose& pose, TickReport& report) noexcept {
  collide::RemovalSums sums;
  const bool by_decay = state.backend.decay != nullptr;
  const bool removed =
      by_decay
          ? work_or_fail_over(state, [&](const Backend& backend) { return backend.decay->apply(pose, sums); })
          : cut_profile(state, pose, sums);
  if (!removed) return false;
  const std::span<const uint32_t> changed =
      by_decay ? state.backend.decay->changed_bricks()
               : std::span<const uint32_t>(state.changed.data(), state.changed_count);
  if (!publish_changes(state, changed)) return false;
  for (size_t k = 0; k < 3; ++k) report.coverage_removed[k] = sums.coverage_removed[k];
  report.changed_bricks = sums.changed_bricks;
  if (sums.changed_bricks != 0) {
    state.session_hash = hash_combine(state.session_hash, sums.change_hash);
  }
  return true;
}

}  // namespace ream::sim
