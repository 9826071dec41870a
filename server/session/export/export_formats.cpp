#include "session/export/export_formats.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/log.hpp"
#include "geometry/mesh_io.hpp"
#include "geometry/scene_export.hpp"
#include "net/problem.hpp"
#include "record/recorded_bone.hpp"
#include "report/deviation_scale.hpp"
#include "report/report.hpp"
#include "score/deviation.hpp"
#include "session/export/cause_export.hpp"
#include "session/export/reamed_bone.hpp"
#include "session/export/session_bundle.hpp"
#include "session/export/session_report.hpp"
#include "session/export/session_tables.hpp"
#include "session/simulation/find_case.hpp"
#include "session/simulation/reamed_pictures.hpp"
#include "session/simulation/recorded_session.hpp"

namespace ream::session {
namespace {

namespace fs = std::filesystem;

void write_bundle(const ExportRequest& request, const fs::path& out, const Progress& progress) {
  write_session_bundle(request.recording, request.case_name, request.data, out,
                       request.labels ? &*request.labels : nullptr, progress);
}

void write_html(const ExportRequest& request, const fs::path& out, const Progress& progress) {
  write_file_atomically(out, report::html_of(session_report(request, progress)));
}

void write_pdf(const ExportRequest& request, const fs::path& out, const Progress& progress) {
  write_file_atomically(out, report::pdf_of(session_report(request, progress)));
}

/// Bone and implant in the world frame.
struct Surfaces {
  TriangleMesh bone, implant;  ///< the implant is empty where none can be seated
  score::DeviationFields deviation;
  case_::Side side = case_::Side::right;

  std::string remark() const { return case_::frame_in_words(side); }
};

Surfaces surfaces_of(const ExportRequest& request, const Progress& progress) {
  const record::Recording recording = recording_of(request);
  const score::MetricsAccumulator ticks = accumulated(recording, part_of(progress, 0.0, 0.5));
  progress(0.5, "comparing surfaces");
  ComparedBone compared = reamed_bone(recording, ticks, request.case_name, request.data);
  const Pose& world_from_grid = compared.bone.world_from_grid;
  progress(0.9, "writing");
  return {compared.bone.after.transformed(world_from_grid),
          compared.implant.transformed(world_from_grid),
          {std::move(compared.bone.from_plan), std::move(compared.bone.from_implant),
           std::move(compared.bone.wall)},
          compared.bone.side};
}

/// The bone, coloured where there is a plan to compare with, and the implant.
std::vector<SceneObject> scene_of(const Surfaces& surfaces) {
  SceneObject bone;
  bone.name = "bone";
  bone.mesh = &surfaces.bone;
  for (const int8_t code : surfaces.deviation.from_plan) {
    const render::VertexColour colour = report::deviation_colour(code);
    bone.colours.push_back({colour.red, colour.green, colour.blue});
  }
  if (!surfaces.deviation.from_plan.empty())
    bone.properties.push_back({"deviation_plan", surfaces.deviation.from_plan});
  if (!surfaces.deviation.from_implant.empty())
    bone.properties.push_back({"deviation_implant", surfaces.deviation.from_implant});
  std::vector<SceneObject> objects = {std::move(bone)};
  if (!surfaces.implant.triangles.empty()) {
    SceneObject implant;
    implant.name = "implant";
    implant.mesh = &surfaces.implant;
    objects.push_back(std::move(implant));
  }
  return objects;
}

/// The recording's case, its coverage what the session left.
case_::Case left_case(const ExportRequest& request, std::vector<uint8_t>& before, const Progress& progress) {
  progress(0.0, "reading the case");
  const record::Recording recording = recording_of(request);
  case_::Case bone_case = case_of(recording, request.case_name, request.data);
  progress(0.2, "reading the recording");
  voxel::BoneModel& bone = bone_case.bone;
  before = bone.coverage;
  record::RecordedBone recorded(recording, bone.grid, bone.coverage);
  recorded.seek(UINT32_MAX, [](const voxel::BrickImage&) {});
  recorded.write_to(bone.coverage);
  progress(0.5, "finding the surface");
  return bone_case;
}

void write_stl_bone(const ExportRequest& request, const fs::path& out, const Progress& progress) {
  std::vector<uint8_t> before;
  const case_::Case left = left_case(request, before, progress);
  write_file_atomically(out,
                        stl_of(reamed_surface(left), "reamed bone, " + case_::frame_in_words(left.side)));
}

void write_stl_implant(const ExportRequest& request, const fs::path& out, const Progress& progress) {
  const Surfaces surfaces = surfaces_of(request, progress);
  if (surfaces.implant.triangles.empty())
    throw Error(ErrorKind::conflict,
                "no implant can be seated: its plan says nothing of an implant, or no bone was reamed");
  write_file_atomically(out, stl_of(surfaces.implant, "seated implant, " + surfaces.remark()));
}

void write_ply_scene(const ExportRequest& request, const fs::path& out, const Progress& progress) {
  const Surfaces surfaces = surfaces_of(request, progress);
  write_file_atomically(out, ply_of(scene_of(surfaces), surfaces.remark()));
}

void write_glb_scene(const ExportRequest& request, const fs::path& out, const Progress& progress) {
  const Surfaces surfaces = surfaces_of(request, progress);
  write_file_atomically(out, glb_of(scene_of(surfaces), surfaces.remark()));
}

void write_surface(const ExportRequest& request, const fs::path& out, const Progress& progress) {
  std::vector<uint8_t> before;
  const case_::Case left = left_case(request, before, progress);
  write_ply(out, reamed_surface(left), case_::frame_in_words(left.side));
}

void write_snapshot(const ExportRequest& request, const fs::path& out, const Progress& progress) {
  std::vector<uint8_t> before;
  const case_::Case left = left_case(request, before, progress);
  write_picture(left, before, out,
                case_surroundings(request.case_name.empty() ? left.id : request.case_name, request.data));
}

}  // namespace

void write_deviations(const ExportRequest& request, const fs::path& out, const Progress& progress) {
  const Surfaces surfaces = surfaces_of(request, progress);
  score::write_deviation(out, "reamed.ply", surfaces.bone.vertices_mm.size(), surfaces.deviation);
}

record::Recording recording_of(const ExportRequest& request) {
  record::Recording recording(request.recording, record::Recording::Trust::checked);
  if (const std::string& damage = recording.log().damage(); !damage.empty()) log::warn(damage);
  return recording;
}

const std::vector<ExportFormat>& export_formats() {
  using enum ExportKind;
  static const std::vector<ExportFormat> formats = {
      {"pdf", ".pdf", "report for printing", "application/pdf", report, write_pdf},
      {"review", ".review.html", "review as a page that opens anywhere, without a server",
       "text/html; charset=utf-8", plain, write_review_file},
      {"html", ".html", "report as a page", "text/html; charset=utf-8", report, write_html},
      {"csv", ".csv", "one row a tick", "text/csv; charset=utf-8", table, write_trace},
      {"parquet", ".parquet", "the same with types and units", "application/vnd.apache.parquet", table,
       write_parquet},
      {"hdf5", ".h5", "every tick, metrics, score, plan and bone", "application/x-hdf5", local, write_hdf5},
      {"ply", ".ply", "reamed bone and implant, coloured by deviation", "application/ply", plain,
       write_ply_scene},
      {"glb", ".glb", "the same as glTF", "model/gltf-binary", plain, write_glb_scene},
      {"stl", ".stl", "reamed bone", "model/stl", plain, write_stl_bone},
      {"implant", ".stl", "implant as it would be seated", "model/stl", plain, write_stl_implant},
      {"surface", ".ply", "reamed bone alone, as a run writes it", "application/ply", plain, write_surface},
      {"png", ".png", "picture of the reamed glenoid", "image/png", plain, write_snapshot},
      {"deviations", ".json", "deviations vertex by vertex; bytes beside it", "application/json", pair,
       write_deviations},
      {"zip", ".zip", "session and case, for ream import on another machine", "application/zip", plain,
       write_bundle},
      {"causes", ".causes", "what computes the bone again anywhere", "application/octet-stream", plain,
       write_causes},
  };
  return formats;
}

const ExportFormat& export_format_of(const std::string& name, const fs::path& out) {
  std::string names, endings;
  // "review.html" by itself is a review, too.
  const std::string dotted = "." + out.filename().string();
  const auto ends_in = [&](const std::string& extension) {
    return out.has_extension() && dotted.ends_with(extension);
  };
  for (const ExportFormat& format : export_formats()) {
    if (name.empty() ? ends_in(format.extension) : name == format.name) return format;
    names += (names.empty() ? "" : ", ") + format.name;
    endings += (endings.empty() ? "" : ", ") + format.extension + " (" + format.words + ")";
  }
  if (!name.empty()) throw Error(ErrorKind::usage, "--format " + name + " must be one of " + names);
  throw Error(ErrorKind::usage, "--out " + out.string() + " must end in one of " + endings);
}

const ExportFormat& served_export_format(const std::string& name) {
  std::string names;
  for (const ExportFormat& format : export_formats()) {
    if (format.kind == ExportKind::pair || format.kind == ExportKind::local) continue;
    if (format.name == name) return format;
    names += (names.empty() ? "" : ", ") + format.name;
  }
  throw net::RequestError(422, "sessions cannot be exported as '" + name + "'; there are " + names,
                          {{"#/format", "must be one of " + names}});
}

}  // namespace ream::session
