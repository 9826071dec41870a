#include "session/simulation/recorded_coverages.hpp"

#include "core/error.hpp"
#include "record/recorded_bone.hpp"

namespace ream::session {

Coverages coverages_of(const record::Recording& recording, case_::Case& native_case) {
  voxel::BoneModel& bone = native_case.bone;
  Coverages all;
  all.native = bone.coverage;
  case_::cut_pilot_hole(bone, *native_case.plan);
  if (bone.coverage_hash() != recording.header().start_grid_hash)
    throw Error(ErrorKind::conflict,
                "the bone of case '" + native_case.id + "' is not that of the recording");
  all.start = bone.coverage;
  record::RecordedBone recorded(recording, bone.grid, all.start);
  recorded.seek(recording.tick_count(), [](const voxel::BrickImage&) {});
  all.left = bone.coverage;
  recorded.write_to(all.left);
  return all;
}

}  // namespace ream::session
