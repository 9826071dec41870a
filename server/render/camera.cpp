#include "render/camera.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "core/error.hpp"

namespace ream::render {

Mat4f camera_from_world(const Camera& camera) {
  const Vec3 to_target = camera.target_mm - camera.eye_mm;
  if (!(to_target.norm() > 0.0) || !to_target.allFinite())
    throw Error(ErrorKind::invalid_input,
                "picture: the camera's eye and target are the same point; move one of them");
  const Vec3 back = -to_target.normalized();
  Vec3 right = camera.up.cross(back);
  if (right.norm() < 1e-9) right = back.unitOrthogonal();
  right.normalize();
  Mat3 rotation;
  rotation.row(0) = right;
  rotation.row(1) = back.cross(right);
  rotation.row(2) = back;
  Mat4f result = Mat4f::Identity();
  result.topLeftCorner<3, 3>() = rotation.cast<float>();
  result.topRightCorner<3, 1>() = (-rotation * camera.eye_mm).cast<float>();
  return result;
}

Mat4f clip_from_camera(double vertical_field_of_view_rad, double aspect, double near_mm, double far_mm) {
  const double scale = 1.0 / std::tan(0.5 * vertical_field_of_view_rad), depth = near_mm - far_mm;
  Mat4f result = Mat4f::Zero();
  result(0, 0) = static_cast<float>(scale / aspect);
  result(1, 1) = static_cast<float>(scale);
  result(2, 2) = static_cast<float>((far_mm + near_mm) / depth);
  result(2, 3) = static_cast<float>(2.0 * far_mm * near_mm / depth);
  result(3, 2) = -1.0f;
  return result;
}

std::optional<std::array<double, 2>> place_in_picture(const Camera& camera, double aspect,
                                                      const Vec3& world_mm) {
  const Eigen::Vector4d world(world_mm.x(), world_mm.y(), world_mm.z(), 1.0);
  const Eigen::Vector4d seen = camera_from_world(camera).cast<double>() * world;
  if (seen.z() >= 0.0) return std::nullopt;
  const double half_height = -seen.z() * std::tan(0.5 * camera.vertical_field_of_view_rad);
  return std::array{0.5 + 0.5 * seen.x() / (half_height * aspect), 0.5 - 0.5 * seen.y() / half_height};
}

}  // namespace ream::render
