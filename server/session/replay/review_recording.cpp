#include "session/replay/review_recording.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/interrupt.hpp"
#include "record/recorded_bone.hpp"
#include "score/depth_gauge.hpp"
#include "score/metrics.hpp"
#include "session/simulation/recorded_session.hpp"
#include "session/simulation/simulation.hpp"

namespace ream::session {
namespace {

void compare(Review& review, const record::ops::Checkpoint& checkpoint, uint64_t session_hash,
             const record::RecordedBone& bone) {
  ++review.checkpoints;
  if (review.difference) return;
  review.difference_tick = checkpoint.tick;
  if (session_hash != checkpoint.session_hash)
    review.difference = {"checkpoint", "session_hash", to_hex(checkpoint.session_hash), to_hex(session_hash)};
  else if (bone.ticks() == checkpoint.tick + 1 && bone.coverage_hash() != checkpoint.grid_hash)
    review.difference = {"bone", "grid_hash", to_hex(checkpoint.grid_hash), to_hex(bone.coverage_hash())};
}

double depth_of(const record::RecordedBone& bone, const voxel::BoneModel& start,
                const std::shared_ptr<const score::NativeGlenoid>& native) {
  std::vector<uint8_t> left(start.coverage.begin(), start.coverage.end());
  bone.write_to(left);
  return score::DepthGauge(native).measure({start.grid, left.data()});
}

}  // namespace

Review review_recording(const record::Recording& recording, case_::Case bone_case,
                        const std::shared_ptr<const score::NativeGlenoid>& native, uint32_t until_tick) {
  const case_::Case before = as_before_tick_0(recording, std::move(bone_case));
  const voxel::BoneModel& start = before.bone;
  record::RecordedBone bone(recording, start.grid, start.coverage);
  score::MetricsAccumulator metrics(start.grid.voxel_volume_mm3(),
                                    sim::world_from_plan(plan_of(before)).inverse());
  Review review;
  const uint32_t end = std::min(until_tick, recording.tick_count());
  uint32_t first = 0;
  const auto read_ticks = [&](uint32_t last) {
    recording.for_each_tick(first, last, [&](const record::ops::Tick& tick) {
      metrics.add(record::report_of(tick, start.grid.world_from_grid));
      ++review.ticks;
    });
    first = last;
  };
  const auto nothing = [](const voxel::BrickImage&) {};
  for (const record::ops::Checkpoint& checkpoint : recording.checkpoints()) {
    if (checkpoint.tick >= end) break;
    throw_if_interrupted();
    read_ticks(checkpoint.tick + 1);
    bone.seek(checkpoint.tick + 1, nothing);
    compare(review, checkpoint, metrics.session_hash(), bone);
  }
  read_ticks(end);
  bone.seek(end, nothing);
  review.removed_volume_mm3 = metrics.removed_volume_mm3();
  if (native) review.reaming_depth_mm = depth_of(bone, start, native);
  review.session_hash = metrics.session_hash();
  review.grid_hash = bone.coverage_hash();
  review.grid_ticks = bone.ticks();
  return review;
}

}  // namespace ream::session
