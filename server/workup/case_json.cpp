#include "workup/case_json.hpp"

#include <nlohmann/json.hpp>
#include <optional>

#include "case/landmarks.hpp"
#include "case/plan.hpp"
#include "core/file.hpp"
#include "ct/build/ct_workspace.hpp"
#include "geometry/pose_json.hpp"

namespace ream::workup {
namespace fs = std::filesystem;
using nlohmann::json;
namespace {

json list(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
json list(const Vec3i& v) { return {v.x(), v.y(), v.z()}; }

/// What lies in a case folder, without voxels.
struct Contents {
  std::optional<case_::Case> built;
  std::optional<ct::Workup> workup;
  std::optional<case_::Plan> plan;
};

Contents contents_of(const fs::path& folder) {
  Contents contents;
  if (ct::has_workup(folder)) contents.workup = ct::load_workup(folder);
  if (fs::exists(folder / "case.json") || !contents.workup) {
    contents.built = case_::load_case_description(folder);
    contents.plan = contents.built->plan;
  } else if (fs::exists(folder / "plan.json")) {
    contents.plan =
        case_::plan_from_json(read_json_file(folder / "plan.json"), (folder / "plan.json").string());
  }
  return contents;
}

json summary_of(const Contents& contents) {
  const auto& [built, workup, plan] = contents;
  json value = {{"id", built ? built->id : workup->id},
                {"name", built ? built->name : workup->name},
                {"side", case_::to_text(built ? built->side : workup->side)},
                {"stage", built                    ? "built"
                          : workup->segmentation() ? "segmented"
                                                   : "ct"},
                {"dims", nullptr},
                {"spacing_mm", nullptr},
                {"planned", plan.has_value()}};
  if (built) {
    value["dims"] = list(built->bone.grid.dims);
    value["spacing_mm"] = list(built->bone.grid.spacing_mm);
  }
  return value;
}

json ct_json(const ct::Workup& workup) {
  return {{"dims", list(workup.volume.dims)},
          {"spacing_mm", list(workup.volume.spacing_mm)},
          {"world_from_volume", ream::to_json(workup.volume.world_from_volume)},
          {"hu_min", workup.hu_min},
          {"hu_max", workup.hu_max},
          {"source", workup.volume.source},
          {"revision", 1},
          {"suggested_threshold_hu", workup.suggested_threshold_hu}};
}

json segmentation_json(const ct::Workup& workup) {
  const ct::SegmentationRecord* record = workup.segmentation();
  if (!record) return nullptr;
  json parts = json::array();
  for (const ct::BonePart& part : record->parts) parts.push_back(ct::to_json(part));
  json head, glenoid;
  if (record->head)
    head = {{"centre_mm", list(record->head->centre_mm)}, {"radius_mm", record->head->radius_mm}};
  if (record->glenoid_mm) glenoid = list(*record->glenoid_mm);
  return {{"revision", record->revision},
          {"humeral_head", std::move(head)},
          {"glenoid_mm", std::move(glenoid)},
          {"can_undo", workup.segmentations.size() > 1},
          {"settings", ct::to_json(record->settings)},
          {"threshold_hu", record->threshold_hu},
          {"parts", std::move(parts)},
          {"warnings", record->warnings}};
}

json built_json(const ct::Workup& workup) {
  if (!workup.built) return nullptr;
  const ct::BuildRecord& built = *workup.built;
  json value = ct::to_json(built.settings);
  const Vec3 &low = built.roi_mm.min, &high = built.roi_mm.max;
  value["roi_mm"] = {low.x(), low.y(), low.z(), high.x(), high.y(), high.z()};
  value["bone_voxels"] = built.bone_voxels;
  value["density_range_g_cc"] = built.density_range_g_cc;
  value["segmentation_revision"] = built.segmentation_revision;
  return value;
}

}  // namespace

bool is_case_folder(const fs::path& folder) {
  std::error_code failed;
  return fs::is_regular_file(folder / "case.json", failed) || ct::has_workup(folder);
}

json plan_json(const case_::Plan& plan) {
  json value = case_::to_json(plan);
  for (const char* key : {"pilot_diameter_mm", "pilot_depth_mm"})
    if (!value.contains(key)) value[key] = nullptr;
  value["guide"] = case_::to_text(plan.guide);
  return value;
}

json case_summary_json(const fs::path& folder) { return summary_of(contents_of(folder)); }

json case_json(const fs::path& folder) {
  const Contents contents = contents_of(folder);
  const auto& [built, workup, plan] = contents;
  json value = summary_of(contents);
  value["warnings"] = built ? built->warnings : workup->volume.warnings;
  value["ct"] = workup ? ct_json(*workup) : json(nullptr);
  value["segmentation"] = workup ? segmentation_json(*workup) : json(nullptr);
  value["built"] = workup ? built_json(*workup) : json(nullptr);
  const auto landmarks = case_::load_landmarks(folder);
  value["landmarks"] = landmarks ? case_::to_json(*landmarks) : json(nullptr);
  value["plan"] = plan ? plan_json(*plan) : json(nullptr);
  return value;
}

}  // namespace ream::workup
