#include "app/export_surfaces.hpp"

#include "app/reamed_bone.hpp"
#include "app/recorded_session.hpp"
#include "core/file.hpp"
#include "core/log.hpp"
#include "geometry/scene_export.hpp"
#include "report/deviation_scale.hpp"
#include "score/deviation_file.hpp"

namespace ream::app {
namespace {

namespace fs = std::filesystem;

/// Bone and implant in the world frame.
struct Surfaces {
  TriangleMesh bone, implant;  ///< the implant is empty where none can be seated
  score::DeviationFields deviation;
  case_::Side side = case_::Side::right;

  std::string remark() const { return case_::frame_in_words(side); }
};

Surfaces surfaces_of(const ExportRequest& request, const Progress& progress) {
  const record::Recording recording(request.recording, record::Recording::Trust::checked);
  if (const std::string& damage = recording.log().damage(); !damage.empty()) log::warn(damage);
  const score::MetricsAccumulator ticks = accumulated(recording, part_of(progress, 0.0, 0.5));
  progress(0.5, "comparing surfaces");
  ComparedBone compared = reamed_bone(recording, ticks, request.case_name, request.data);
  const Pose& world_from_grid = compared.bone.world_from_grid;
  progress(0.9, "writing");
  return {compared.bone.after.transformed(world_from_grid),
          compared.implant.transformed(world_from_grid),
          {std::move(compared.bone.from_plan), std::move(compared.bone.from_implant)},
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

}  // namespace

void write_stl(const ExportRequest& request, const fs::path& out, const Progress& progress) {
  const Surfaces surfaces = surfaces_of(request, progress);
  fs::path beside = out;
  beside.replace_filename(out.stem().string() + "-implant.stl");
  if (!surfaces.implant.triangles.empty())
    write_file_atomically(beside, stl_of(surfaces.implant, "seated implant, " + surfaces.remark()));
  write_file_atomically(out, stl_of(surfaces.bone, "reamed bone, " + surfaces.remark()));
}

void write_coloured_ply(const ExportRequest& request, const fs::path& out, const Progress& progress) {
  const Surfaces surfaces = surfaces_of(request, progress);
  write_file_atomically(out, ply_of(scene_of(surfaces), surfaces.remark()));
}

void write_glb(const ExportRequest& request, const fs::path& out, const Progress& progress) {
  const Surfaces surfaces = surfaces_of(request, progress);
  write_file_atomically(out, glb_of(scene_of(surfaces), surfaces.remark()));
}

void write_deviations(const ExportRequest& request, const fs::path& out, const Progress& progress) {
  const Surfaces surfaces = surfaces_of(request, progress);
  score::write_deviation(out, "reamed.ply", surfaces.bone.vertices_mm.size(), surfaces.deviation);
}

}  // namespace ream::app
