#include "ct/build/ct_workspace.hpp"

#include <array>
#include <nlohmann/json.hpp>

#include "case/case.hpp"
#include "core/error.hpp"
#include "core/json_reader.hpp"
#include "geometry/pose_json.hpp"

namespace ream::ct {
using nlohmann::json;
namespace {

constexpr double max_sigma_mm = 5.0, max_cartilage_mm = 6.0, max_voxels = 2.0e9;
constexpr std::array labels{BoneLabel::scapula, BoneLabel::humerus, BoneLabel::clavicle, BoneLabel::other};

json list(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
Vec3 vec3(const std::vector<double>& n) { return {n[0], n[1], n[2]}; }

std::optional<Vec3> point_or_none(JsonReader& reader, const std::string& key) {
  if (!reader.has(key)) return std::nullopt;
  return vec3(reader.numbers(key, 3));
}

BonePart part_from(JsonReader reader) {
  BonePart part;
  const std::string name = reader.text("name");
  for (const BoneLabel label : labels)
    if (to_text(label) == name) part.label = label;
  if (part.label == BoneLabel::none) reader.refuse("name", "is no bone");
  reader.integer("label", 1, 255);
  part.voxels = reader.unsigned_integer("voxels");
  part.volume_mm3 = reader.number("volume_mm3", 0.0);
  part.centre_mm = vec3(reader.numbers("centre_mm", 3));
  part.low_mm = vec3(reader.numbers("low_mm", 3));
  part.high_mm = vec3(reader.numbers("high_mm", 3));
  reader.finish();
  return part;
}

json to_json(const HumeralHead& head) {
  return {{"centre_mm", list(head.centre_mm)}, {"radius_mm", head.radius_mm}, {"share", head.share}};
}

json to_json(const SegmentationRecord& record) {
  json parts = json::array();
  for (const BonePart& part : record.parts) parts.push_back(to_json(part));
  json value = {{"revision", record.revision},
                {"settings", to_json(record.settings)},
                {"threshold_hu", record.threshold_hu},
                {"parts", std::move(parts)},
                {"warnings", record.warnings}};
  if (record.head) value["head"] = to_json(*record.head);
  if (record.glenoid_mm) value["glenoid_mm"] = list(*record.glenoid_mm);
  return value;
}

HumeralHead head_from(JsonReader reader) {
  HumeralHead head;
  head.centre_mm = vec3(reader.numbers("centre_mm", 3));
  head.radius_mm = reader.number("radius_mm", 0.0, 100.0);
  head.share = reader.number("share", 0.0, 1.0);
  reader.finish();
  return head;
}

SegmentationSettings settings_from(JsonReader reader) {
  SegmentationSettings settings;
  if (reader.has("threshold_hu")) settings.threshold_hu = reader.number("threshold_hu", -1000.0, 4000.0);
  settings.sigma_mm = reader.number_or("sigma_mm", settings.sigma_mm, 0.0, max_sigma_mm);
  settings.separate = reader.boolean_or("separate", settings.separate);
  settings.fill_holes = reader.boolean_or("fill_holes", settings.fill_holes);
  if (reader.has("seeds")) {
    JsonReader seeds = reader.object("seeds");
    settings.seeds.scapula_mm = point_or_none(seeds, "scapula");
    settings.seeds.humerus_mm = point_or_none(seeds, "humerus");
    settings.seeds.clavicle_mm = point_or_none(seeds, "clavicle");
    seeds.finish();
  }
  reader.finish();
  return settings;
}

SegmentationRecord record_from(JsonReader reader) {
  SegmentationRecord record;
  record.revision = static_cast<int>(reader.integer("revision", 1, INT32_MAX));
  record.settings = settings_from(reader.object("settings"));
  record.threshold_hu = reader.number("threshold_hu");
  for (JsonReader& part : reader.objects("parts")) record.parts.push_back(part_from(std::move(part)));
  if (reader.has("head")) record.head = head_from(reader.object("head"));
  record.glenoid_mm = point_or_none(reader, "glenoid_mm");
  record.warnings = reader.texts_or_none("warnings");
  reader.finish();
  return record;
}

BuildSettings build_from(const json& value, const std::string& place) {
  JsonReader reader(value, place);
  BuildSettings settings;
  settings.upsample = static_cast<int>(reader.integer_or("upsample", settings.upsample, 1, 16));
  const std::string roi = reader.text_or("roi", "glenoid");
  if (roi != "glenoid" && roi != "whole") reader.refuse("roi", "must be glenoid or whole");
  settings.around_glenoid = roi == "glenoid";
  settings.cartilage_mm = reader.number_or("cartilage_mm", 0.0, 0.0, max_cartilage_mm);
  if (reader.has("calibration")) {
    if (!value.at("calibration").is_object()) reader.refuse("calibration", "must be an object");
    json laws = value.at("calibration");
    if (laws.contains("threshold_hu"))
      reader.refuse("calibration", "takes no threshold_hu: the segmentation's is used");
    laws["threshold_hu"] = 0.0;
    settings.calibration = case_::calibration_from_json(laws, reader.place() + ".calibration");
  }
  reader.finish();
  return settings;
}

json to_json(const BuildRecord& record) {
  json value = to_json(record.settings);
  value["low_mm"] = list(record.roi_mm.min);
  value["high_mm"] = list(record.roi_mm.max);
  value["bone_voxels"] = record.bone_voxels;
  value["density_range_g_cc"] = record.density_range_g_cc;
  value["segmentation_revision"] = record.segmentation_revision;
  return value;
}

BuildRecord built_from(const json& value, JsonReader reader) {
  BuildRecord record;
  json settings;
  for (const char* key : {"upsample", "roi", "cartilage_mm", "calibration"}) {
    if (!reader.has(key)) reader.refuse(key, "is missing");
    settings[key] = value.at(key);
  }
  record.settings = build_settings_from_json(settings, reader.place());
  record.roi_mm = {vec3(reader.numbers("low_mm", 3)), vec3(reader.numbers("high_mm", 3))};
  record.bone_voxels = reader.unsigned_integer("bone_voxels");
  const auto densities = reader.numbers("density_range_g_cc", 2);
  record.density_range_g_cc = {densities[0], densities[1]};
  record.segmentation_revision = static_cast<int>(reader.integer("segmentation_revision", 1, INT32_MAX));
  reader.finish();
  return record;
}

void read_volume(JsonReader reader, HuVolume& volume) {
  const auto dims = reader.numbers("dims", 3);
  if (dims[0] * dims[1] * dims[2] > max_voxels) reader.refuse("dims", "is more than 2e9 voxels");
  for (int axis = 0; axis < 3; ++axis) {
    const double d = dims[static_cast<size_t>(axis)];
    if (!(d >= 1.0 && d <= 65535.0)) reader.refuse("dims", "must be three positive whole numbers");
    volume.dims[axis] = static_cast<int>(d);
  }
  volume.spacing_mm = vec3(reader.numbers("spacing_mm", 3));
  if (!(volume.spacing_mm.array() > 0.0).all()) reader.refuse("spacing_mm", "must be positive");
  volume.world_from_volume = pose_from_json(reader.object("world_from_volume"));
  reader.finish();
}

}  // namespace

json to_json(const BonePart& part) {
  return {{"label", static_cast<int>(part.label)},
          {"name", to_text(part.label)},
          {"voxels", part.voxels},
          {"volume_mm3", part.volume_mm3},
          {"centre_mm", list(part.centre_mm)},
          {"low_mm", list(part.low_mm)},
          {"high_mm", list(part.high_mm)}};
}

json to_json(const SegmentationSettings& settings) {
  json value = {
      {"sigma_mm", settings.sigma_mm}, {"separate", settings.separate}, {"fill_holes", settings.fill_holes}};
  if (settings.threshold_hu) value["threshold_hu"] = *settings.threshold_hu;
  json seeds = json::object();
  for (const auto& [key, seed] :
       {std::pair{"scapula", settings.seeds.scapula_mm}, std::pair{"humerus", settings.seeds.humerus_mm},
        std::pair{"clavicle", settings.seeds.clavicle_mm}})
    if (seed) seeds[key] = list(*seed);
  if (!seeds.empty()) value["seeds"] = std::move(seeds);
  return value;
}

SegmentationSettings segmentation_settings_from_json(const json& value, const std::string& place) {
  return settings_from(JsonReader(value, place));
}

json to_json(const BuildSettings& settings) {
  json laws = case_::to_json(settings.calibration);
  laws.erase("threshold_hu");
  return {{"upsample", settings.upsample},
          {"roi", settings.around_glenoid ? "glenoid" : "whole"},
          {"cartilage_mm", settings.cartilage_mm},
          {"calibration", std::move(laws)}};
}

BuildSettings build_settings_from_json(const json& value, const std::string& place) {
  return build_from(value, place);
}

json to_json(const Workup& workup) {
  const Vec3i& dims = workup.volume.dims;
  json segmentations = json::array();
  for (const SegmentationRecord& record : workup.segmentations) segmentations.push_back(to_json(record));
  json value = {{"id", workup.id},
                {"name", workup.name},
                {"side", case_::to_text(workup.side)},
                {"source", workup.volume.source},
                {"warnings", workup.volume.warnings},
                {"volume",
                 {{"dims", {dims.x(), dims.y(), dims.z()}},
                  {"spacing_mm", list(workup.volume.spacing_mm)},
                  {"world_from_volume", ream::to_json(workup.volume.world_from_volume)}}},
                {"hu_min", workup.hu_min},
                {"hu_max", workup.hu_max},
                {"suggested_threshold_hu", workup.suggested_threshold_hu},
                {"last_revision", workup.last_revision},
                {"segmentations", std::move(segmentations)}};
  if (workup.built) value["built"] = to_json(*workup.built);
  return value;
}

Workup workup_from_json(const json& value, const std::string& place) {
  JsonReader reader(value, place);
  Workup workup;
  workup.id = reader.text("id");
  workup.name = reader.text("name");
  const std::string side = reader.text("side");
  if (side != "left" && side != "right") reader.refuse("side", "must be left or right");
  workup.side = case_::side_from_text(side);
  workup.volume.source = reader.text("source");
  workup.volume.warnings = reader.texts_or_none("warnings");
  read_volume(reader.object("volume"), workup.volume);
  workup.hu_min = static_cast<int>(reader.integer("hu_min", -32768, 32767));
  workup.hu_max = static_cast<int>(reader.integer("hu_max", -32768, 32767));
  workup.suggested_threshold_hu = reader.number("suggested_threshold_hu");
  workup.last_revision = static_cast<int>(reader.integer("last_revision", 0, INT32_MAX));
  for (JsonReader& record : reader.objects("segmentations"))
    workup.segmentations.push_back(record_from(std::move(record)));
  for (SegmentationRecord& record : workup.segmentations) record.settings.side = workup.side;
  if (reader.has("built")) workup.built = built_from(value.at("built"), reader.object("built"));
  reader.finish();
  return workup;
}

}  // namespace ream::ct
