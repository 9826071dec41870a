#include "case/landmarks.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "case/case.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/json_reader.hpp"
#include "geometry/pose_json.hpp"

namespace ream::case_ {
using nlohmann::json;
namespace {

constexpr double max_landmark_coordinate_mm = 1e5;
constexpr double min_head_radius_mm = 5.0, max_head_radius_mm = 60.0;
constexpr size_t biconcavity_points = 3;
constexpr std::array walch_classes = {"A1", "A2", "B1", "B2", "B3", "C1", "C2", "D"};

struct NamedPoint {
  const char* key;
  std::optional<Vec3> Landmarks::*point;
};
constexpr std::array named_points = {NamedPoint{"glenoid_centre_mm", &Landmarks::glenoid_centre_mm},
                                     NamedPoint{"superior_rim_mm", &Landmarks::superior_rim_mm},
                                     NamedPoint{"inferior_rim_mm", &Landmarks::inferior_rim_mm},
                                     NamedPoint{"anterior_rim_mm", &Landmarks::anterior_rim_mm},
                                     NamedPoint{"posterior_rim_mm", &Landmarks::posterior_rim_mm},
                                     NamedPoint{"trigonum_mm", &Landmarks::trigonum_mm},
                                     NamedPoint{"inferior_angle_mm", &Landmarks::inferior_angle_mm}};

Vec3 read_point(JsonReader& reader, const std::string& key) {
  const Vec3 point = read_vec3(reader, key);
  if (!(point.cwiseAbs().maxCoeff() <= max_landmark_coordinate_mm))
    reader.refuse(key, "must be coordinates of at most 100 m, in mm");
  return point;
}

std::vector<Vec3> read_biconcavity(JsonReader& reader, const json& value) {
  const char* key = "biconcavity_mm";
  std::vector<Vec3> points;
  if (!reader.has(key)) return points;
  const json& rows = value.at(key);
  if (!rows.is_array() || rows.size() != biconcavity_points)
    reader.refuse(key,
                  "must be three points: anterior edge of the paleoglenoid, ridge, posterior edge of the "
                  "neoglenoid");
  for (const json& row : rows) {
    // One reader per row, so that its complaints name the same key.
    const json one = {{key, row}};
    JsonReader point(one, reader.place());
    points.push_back(read_point(point, key));
  }
  return points;
}

}  // namespace

Landmarks landmarks_from_json(const json& value, const std::string& place) {
  JsonReader reader(value, place);
  Landmarks landmarks;
  for (const NamedPoint& named : named_points)
    if (reader.has(named.key)) landmarks.*named.point = read_point(reader, named.key);
  if (reader.has("humeral_head")) {
    JsonReader head = reader.object("humeral_head");
    landmarks.humeral_head = HumeralHead{read_point(head, "centre_mm"),
                                         head.number("radius_mm", min_head_radius_mm, max_head_radius_mm)};
    head.finish();
  }
  landmarks.biconcavity_mm = read_biconcavity(reader, value);
  if (reader.has("walch")) {
    landmarks.walch = reader.text("walch");
    if (std::find(walch_classes.begin(), walch_classes.end(), landmarks.walch) == walch_classes.end())
      reader.refuse("walch", "must be A1, A2, B1, B2, B3, C1, C2 or D");
  }
  reader.finish();
  return landmarks;
}

json to_json(const Landmarks& landmarks) {
  json value = json::object();
  for (const NamedPoint& named : named_points)
    if (const auto& point = landmarks.*named.point) value[named.key] = json_of(*point);
  if (const auto& head = landmarks.humeral_head)
    value["humeral_head"] = {{"centre_mm", json_of(head->centre_mm)}, {"radius_mm", head->radius_mm}};
  for (const Vec3& point : landmarks.biconcavity_mm) value["biconcavity_mm"].push_back(json_of(point));
  if (!landmarks.walch.empty()) value["walch"] = landmarks.walch;
  return value;
}

void save_landmarks(const Landmarks& landmarks, const std::filesystem::path& case_folder) {
  const std::filesystem::path file = case_folder / "landmarks.json";
  const json value = to_json(landmarks);
  landmarks_from_json(value, "landmarks of " + case_folder.string());
  write_json_file(file, value);
}

std::optional<Landmarks> load_landmarks(const std::filesystem::path& case_folder) {
  const std::filesystem::path file = case_folder / "landmarks.json";
  if (!std::filesystem::exists(file)) return std::nullopt;
  return landmarks_from_json(read_json_file(file), file.string());
}

Anatomy anatomy_of(const Case& c, const std::filesystem::path& case_folder) {
  return {c.side, load_landmarks(case_folder), c.glenoid};
}

Anatomy anatomy_from_json(const json& value, const std::string& place) {
  JsonReader reader(value, place);
  Anatomy anatomy;
  anatomy.side = side_from_json(reader);
  if (reader.has("landmarks"))
    anatomy.landmarks = landmarks_from_json(value.at("landmarks"), place + ".landmarks");
  if (reader.has("glenoid")) anatomy.glenoid = glenoid_from_json(reader.object("glenoid"));
  reader.finish();
  return anatomy;
}

json to_json(const Anatomy& anatomy) {
  json value = {{"side", to_text(anatomy.side)}};
  if (anatomy.landmarks) value["landmarks"] = to_json(*anatomy.landmarks);
  if (anatomy.glenoid) value["glenoid"] = to_json(*anatomy.glenoid);
  return value;
}

}  // namespace ream::case_
