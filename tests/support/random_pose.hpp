#pragma once
#include <Eigen/Geometry>
#include <random>

#include "core/units.hpp"
#include "geometry/pose.hpp"

namespace ream::test {

inline Vec3 random_vector(std::mt19937& random, double half_width) {
  std::uniform_real_distribution<double> one(-half_width, half_width);
  const double x = one(random), y = one(random), z = one(random);
  return {x, y, z};
}

inline Vec3 random_direction(std::mt19937& random) {
  for (;;) {
    const Vec3 v = random_vector(random, 1.0);
    const double length = v.norm();
    if (length > 0.1 && length < 1.0) return v / length;
  }
}

/// Rotation about `axis` (unit) by Eigen, independent of our own.
inline Mat3 rotation_about(const Vec3& axis, double angle_rad) {
  return Eigen::AngleAxisd(angle_rad, axis).toRotationMatrix();
}

inline Pose random_pose(std::mt19937& random, double reach_mm = 300.0) {
  std::uniform_real_distribution<double> angle(-pi, pi);
  const Vec3 axis = random_direction(random);
  const Mat3 rotation = rotation_about(axis, angle(random));
  return {rotation, random_vector(random, reach_mm)};
}

}  // namespace ream::test
