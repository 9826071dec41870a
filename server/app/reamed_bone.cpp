#include "app/reamed_bone.hpp"

#include "core/error.hpp"
#include "record/recorded_bone.hpp"
#include "score/deviation.hpp"
#include "surface/whole_surface.hpp"

namespace ream::app {

report::ReamedBone reamed_bone(const record::Recording& recording, case_::Case bone_case) {
  voxel::BoneModel& bone = bone_case.bone;
  const std::vector<uint8_t> native = bone.coverage;
  case_::cut_pilot_hole(bone, *bone_case.plan);
  if (bone.coverage_hash() != recording.header().start_grid_hash)
    throw Error(ErrorKind::conflict, "the bone of case '" + bone_case.id + "' is not that of the recording");
  const std::vector<uint8_t> start = bone.coverage;
  record::RecordedBone recorded(recording, bone.grid, start);
  recorded.seek(UINT32_MAX, [](const voxel::BrickImage&) {});
  recorded.write_to(bone.coverage);

  report::ReamedBone reamed;
  reamed.before = surface::whole_surface(bone.grid, start.data());
  reamed.after = surface::whole_surface(bone.grid, bone.coverage.data());
  reamed.world_from_grid = bone.grid.world_from_grid;
  reamed.plan = *bone_case.plan;
  reamed.side = bone_case.side;
  reamed.glenoid = bone_case.glenoid;
  const score::BoneStates states{bone.grid, native.data(), start.data(), bone.coverage.data()};
  reamed.cut = score::cut_vertices(reamed.after.vertices_mm, states);
  return reamed;
}

}  // namespace ream::app
