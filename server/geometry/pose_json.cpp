#include "geometry/pose_json.hpp"

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

namespace ream {
namespace {

constexpr double rotation_tolerance = 1e-6;

nlohmann::json list(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

nlohmann::json to_json(const Pose& pose) {
  const Mat3& r = pose.rotation;
  return {{"rotation", {list(r.row(0).transpose()), list(r.row(1).transpose()), list(r.row(2).transpose())}},
          {"translation_mm", list(pose.translation_mm)}};
}

Pose pose_from_json(JsonReader reader) {
  Pose pose;
  const auto rows = reader.number_rows("rotation", 3, 3);
  for (size_t i = 0; i < 9; ++i) pose.rotation(static_cast<int>(i / 3), static_cast<int>(i % 3)) = rows[i];
  const Mat3& r = pose.rotation;
  const double deviation = (r.transpose() * r - Mat3::Identity()).cwiseAbs().maxCoeff();
  if (!(deviation < rotation_tolerance) || r.row(0).cross(r.row(1)).dot(r.row(2)) < 0.0)
    reader.refuse("rotation", "must be three rows of an orthonormal, right-handed matrix");
  const auto t = reader.numbers("translation_mm", 3);
  pose.translation_mm = {t[0], t[1], t[2]};
  reader.finish();
  return pose;
}

}  // namespace ream
