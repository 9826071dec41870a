#pragma once
#include "geometry/pose.hpp"

namespace ream {

/// m v, each sum in an order that stands here. Eigen adds as a processor's vector instructions suit it, and
/// what decides about bone must be the same bits in a browser, too. The order is Eigen's on x86-64, so that
/// recordings of before verify.
inline Vec3 ordered_product(const Mat3& m, const Vec3& v) {
  return {m(0, 0) * v.x() + m(0, 1) * v.y() + m(0, 2) * v.z(),
          m(1, 0) * v.x() + m(1, 1) * v.y() + m(1, 2) * v.z(),
          m(2, 0) * v.x() + (m(2, 1) * v.y() + m(2, 2) * v.z())};
}

/// As v.norm().
inline double ordered_norm(const Vec3& v) { return std::sqrt(v.x() * v.x() + v.y() * v.y() + v.z() * v.z()); }

/// As a_from_b.point(p).
inline Vec3 ordered_point(const Pose& a_from_b, const Vec3& p) {
  return ordered_product(a_from_b.rotation, p) + a_from_b.translation_mm;
}

}  // namespace ream
