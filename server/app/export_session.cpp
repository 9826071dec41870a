#include "app/export_session.hpp"

#include <algorithm>
#include <cmath>

#include "api/session_folder.hpp"
#include "app/data_folder.hpp"
#include "app/reamed_pictures.hpp"
#include "app/recorded_session.hpp"
#include "app/session_bundle.hpp"
#include "core/clock.hpp"
#include "geometry/mesh_export.hpp"
#include "record/recorded_bone.hpp"
#include "record/trace_csv.hpp"

namespace ream::app {
namespace {

constexpr uint32_t ticks_between_looks = 10'000;

uint32_t tick_at(double time_s) {
  return static_cast<uint32_t>(std::clamp(std::ceil(time_s / tick_s - 0.5), 0.0, 4.0e9));
}

/// The case's coverage becomes what the session left.
void ream(const record::Recording& recording, case_::Case& bone_case, const Progress& progress) {
  progress(0.1, "reading the recording");
  voxel::BoneModel& bone = bone_case.bone;
  record::RecordedBone recorded(recording, bone.grid, bone.coverage);
  recorded.seek(UINT32_MAX, [](const voxel::BrickImage&) {});
  recorded.write_to(bone.coverage);
}

/// By its id only: whoever asks over the network names no files of this machine.
std::filesystem::path file_of(const std::string& id, const std::filesystem::path& data) {
  return api::recording_file(sessions_folder(data) / id);
}

record::Recording recording_of(const std::string& id, const std::filesystem::path& data) {
  return record::Recording(file_of(id, data), record::Recording::Trust::checked);
}

}  // namespace

void export_trace(const record::Recording& recording, const std::filesystem::path& csv,
                  const api::TracePart& part, const Progress& progress) {
  const voxel::VoxelGrid grid = recording.grid();
  const uint32_t first = tick_at(part.from_s);
  const uint32_t end = std::min(part.to_s ? tick_at(*part.to_s) : UINT32_MAX, recording.tick_count());
  record::TraceCsv trace(csv, grid.voxel_volume_mm3());
  recording.for_each_tick(0, end, [&](const record::ops::Tick& tick) {
    if (tick.tick % ticks_between_looks == 0)
      progress(static_cast<double>(tick.tick) / std::max(end, 1u), "writing rows");
    const record::TickReport report = record::report_of(tick, grid.world_from_grid);
    if (tick.tick >= first && (tick.tick - first) % static_cast<uint32_t>(part.stride) == 0)
      trace.add(report);
    else
      trace.pass(report);
  });
  trace.finish();
}

void export_surface(const record::Recording& recording, case_::Case& bone_case,
                    const std::filesystem::path& path, const Progress& progress) {
  ream(recording, bone_case, progress);
  progress(0.4, "finding the surface");
  const TriangleMesh surface = reamed_surface(bone_case);
  progress(0.8, "writing the file");
  write_mesh(path, surface, case_::frame_in_words(bone_case.side));
}

void export_picture(const record::Recording& recording, case_::Case& bone_case,
                    const std::filesystem::path& png, const Progress& progress) {
  const std::vector<uint8_t> before = bone_case.bone.coverage;
  ream(recording, bone_case, progress);
  progress(0.5, "drawing");
  write_picture(bone_case, before, png);
}

api::ExportFormats export_formats(const std::filesystem::path& data) {
  using Path = std::filesystem::path;
  const auto of_bone = [data](auto write) {
    return [data, write](const api::ExportOrder& order, const Path& out, const Progress& progress) {
      progress(0.0, "reading the case");
      const record::Recording recording = recording_of(order.session.id, data);
      case_::Case bone_case = case_of(recording, {}, data);
      write(recording, bone_case, out, progress);
    };
  };
  api::ExportFormats formats;
  formats.add({"ply", "application/ply", false, of_bone(export_surface)});
  formats.add({"stl", "model/stl", false, of_bone(export_surface)});
  formats.add({"glb", "model/gltf-binary", false, of_bone(export_surface)});
  formats.add({"png", "image/png", false, of_bone(export_picture)});
  formats.add({"csv", "text/csv; charset=utf-8", true,
               [data](const api::ExportOrder& order, const Path& out, const Progress& progress) {
                 export_trace(recording_of(order.session.id, data), out, order.part, progress);
               }});
  formats.add({"zip", "application/zip", false,
               [data](const api::ExportOrder& order, const Path& out, const Progress& progress) {
                 write_session_bundle(file_of(order.session.id, data), {}, data, out, &order.session,
                                      progress);
               }});
  return formats;
}

}  // namespace ream::app
