#include "geometry/pose.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "core/units.hpp"

namespace ream {

Pose Pose::inverse() const {
  const Mat3 inverse_rotation = rotation.transpose();
  return {inverse_rotation, -(inverse_rotation * translation_mm)};
}

Pose operator*(const Pose& a_from_b, const Pose& b_from_c) {
  return {a_from_b.rotation * b_from_c.rotation, a_from_b.point(b_from_c.translation_mm)};
}

Mat3 rotation_from_small_vector(const Vec3& v) {
  const double x = 0.5 * v.x(), y = 0.5 * v.y(), z = 0.5 * v.z();
  return rotation_from_quaternion({1.0, x, y, z});
}

Vec3 small_vector_from_rotation(const Mat3& r) {
  const auto q = quaternion_from_rotation(r);
  return Vec3(q[1], q[2], q[3]) * (2.0 / q[0]);
}

Vec3 turn_between(const Mat3& a, const Mat3& b) {
  const Vec3 turn = small_vector_from_rotation(a.transpose() * b);
  if (!turn.allFinite()) return pi * Vec3::UnitZ();
  const double length = turn.norm();
  return length > pi ? Vec3(turn * (pi / length)) : turn;
}

Mat3 orthonormalized(const Mat3& r) {
  Vec3 z = r.col(2).normalized();
  Vec3 x = r.col(0) - z * z.dot(r.col(0));
  x.normalize();
  Mat3 out;
  out << x, z.cross(x), z;
  return out;
}

Mat3 rotation_with_z_along(const Vec3& direction) {
  const Vec3 z = direction.normalized();
  const Vec3 helper = std::abs(z.x()) < 0.9 ? Vec3::UnitX() : Vec3::UnitY();
  const Vec3 x = (helper - z * z.dot(helper)).normalized();
  Mat3 r;
  r << x, z.cross(x), z;
  return r;
}

std::array<double, 4> quaternion_from_rotation(const Mat3& r) {
  // Shepperd's method: start from the largest component so that nothing is divided by a small number.
  const double trace = r(0, 0) + r(1, 1) + r(2, 2);
  std::array<double, 4> q{};
  if (trace > 0.0) {
    const double s = 2.0 * std::sqrt(trace + 1.0);
    q = {0.25 * s, (r(2, 1) - r(1, 2)) / s, (r(0, 2) - r(2, 0)) / s, (r(1, 0) - r(0, 1)) / s};
  } else {
    const int i = r(0, 0) > r(1, 1) ? (r(0, 0) > r(2, 2) ? 0 : 2) : (r(1, 1) > r(2, 2) ? 1 : 2);
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const double s = 2.0 * std::sqrt(1.0 + r(i, i) - r(j, j) - r(k, k));
    q[0] = (r(k, j) - r(j, k)) / s;
    q[static_cast<size_t>(i + 1)] = 0.25 * s;
    q[static_cast<size_t>(j + 1)] = (r(j, i) + r(i, j)) / s;
    q[static_cast<size_t>(k + 1)] = (r(k, i) + r(i, k)) / s;
  }
  if (q[0] < 0.0)
    for (double& c : q) c = -c;
  return q;
}

Mat3 rotation_from_quaternion(const std::array<double, 4>& wxyz) {
  const double w = wxyz[0], x = wxyz[1], y = wxyz[2], z = wxyz[3];
  const double s = 2.0 / (w * w + x * x + y * y + z * z);
  Mat3 r;
  r << 1.0 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y),  //
      s * (x * y + w * z), 1.0 - s * (x * x + z * z), s * (y * z - w * x),   //
      s * (x * z - w * y), s * (y * z + w * x), 1.0 - s * (x * x + y * y);
  return r;
}

QuantisedPose quantised(const Pose& pose) {
  QuantisedPose q;
  for (int row = 0; row < 3; ++row)
    for (int col = 0; col < 3; ++col)
      q.rotation_q30[static_cast<size_t>(3 * row + col)] =
          static_cast<int32_t>(std::llround(pose.rotation(row, col) * 1073741824.0));
  for (int i = 0; i < 3; ++i)
    q.translation_nm[static_cast<size_t>(i)] =
        static_cast<int32_t>(std::llround(pose.translation_mm[i] * 1e6));
  return q;
}

Pose dequantised(const QuantisedPose& pose) {
  Pose p;
  for (int row = 0; row < 3; ++row)
    for (int col = 0; col < 3; ++col)
      p.rotation(row, col) = pose.rotation_q30[static_cast<size_t>(3 * row + col)] * (1.0 / 1073741824.0);
  for (int i = 0; i < 3; ++i) p.translation_mm[i] = pose.translation_nm[static_cast<size_t>(i)] * 1e-6;
  return p;
}

}  // namespace ream
