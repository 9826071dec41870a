#pragma once
#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <utility>

namespace ream {

using Vec3 = Eigen::Vector3d;   ///< mm unless the name says otherwise
using Vec3f = Eigen::Vector3f;  ///< mm, where memory matters (meshes)
using Vec3i = Eigen::Vector3i;  ///< voxel, brick or cell indices
using Mat3 = Eigen::Matrix3d;

/// Upper bound of the length of v without a square root: exact along axes, at most 8 % over elsewhere.
inline double length_bound(const Vec3& v) {
  double a = std::abs(v.x()), b = std::abs(v.y()), c = std::abs(v.z());
  if (a < b) std::swap(a, b);
  if (b < c) std::swap(b, c);
  if (a < b) std::swap(a, b);
  return a + 0.4142135624 * b + 0.3178372452 * c;
}

/// The vector, or one of its direction that is as long as allowed.
inline Vec3 clamp_length(const Vec3& v, double max_length) noexcept {
  const double length = v.norm();
  return length > max_length ? Vec3(v * (max_length / length)) : v;
}

}  // namespace ream
