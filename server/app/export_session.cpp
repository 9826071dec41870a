#include "app/export_session.hpp"

#include "geometry/mesh_io.hpp"
#include "record/recorded_bone.hpp"
#include "record/trace_csv.hpp"
#include "surface/whole_surface.hpp"

namespace ream::app {

void export_trace(const record::Recording& recording, const std::filesystem::path& csv) {
  const voxel::VoxelGrid grid = recording.grid();
  record::TraceCsv trace(csv, grid.voxel_volume_mm3());
  recording.for_each_tick(0, UINT32_MAX, [&](const record::ops::Tick& tick) {
    trace.add(record::report_of(tick, grid.world_from_grid));
  });
  trace.finish();
}

void export_surface(const record::Recording& recording, case_::Case& bone_case,
                    const std::filesystem::path& ply) {
  voxel::BoneModel& bone = bone_case.bone;
  record::RecordedBone recorded(recording, bone.grid, bone.coverage);
  recorded.seek(UINT32_MAX, [](const voxel::BrickImage&) {});
  recorded.write_to(bone.coverage);
  write_ply(ply,
            surface::whole_surface(bone.grid, bone.coverage.data()).transformed(bone.grid.world_from_grid),
            case_::frame_in_words(bone_case.side));
}

}  // namespace ream::app
