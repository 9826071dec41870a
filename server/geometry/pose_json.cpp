#include "geometry/pose_json.hpp"

#include <Eigen/Geometry>

#include "core/json.hpp"

namespace ream {
namespace {

constexpr double rotation_tolerance = 1e-6;

}  // namespace

nlohmann::json json_of(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

Vec3 read_vec3(JsonReader& reader, const std::string& key) {
  const auto n = reader.numbers(key, 3);
  return {n[0], n[1], n[2]};
}

nlohmann::json to_json(const Pose& pose) {
  const Mat3& r = pose.rotation;
  return {{"rotation",
           {json_of(r.row(0).transpose()), json_of(r.row(1).transpose()), json_of(r.row(2).transpose())}},
          {"translation_mm", json_of(pose.translation_mm)}};
}

Pose pose_from_json(JsonReader reader) {
  Pose pose;
  const auto rows = reader.number_rows("rotation", 3, 3);
  for (size_t i = 0; i < 9; ++i) pose.rotation(static_cast<int>(i / 3), static_cast<int>(i % 3)) = rows[i];
  const Mat3& r = pose.rotation;
  const double deviation = (r.transpose() * r - Mat3::Identity()).cwiseAbs().maxCoeff();
  if (!(deviation < rotation_tolerance) || r.row(0).cross(r.row(1)).dot(r.row(2)) < 0.0)
    reader.refuse("rotation", "must be three rows of an orthonormal, right-handed matrix");
  pose.translation_mm = read_vec3(reader, "translation_mm");
  reader.finish();
  return pose;
}

}  // namespace ream
