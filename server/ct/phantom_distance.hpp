#pragma once
#include <algorithm>
#include <cmath>

#include "geometry/vec.hpp"

namespace ream::ct {

/// Polynomial maximum and minimum that round the edge between two surfaces over `width`.
inline double rounded_max(double a, double b, double width) {
  const double h = std::max(width - std::abs(a - b), 0.0) / width;
  return std::max(a, b) + 0.25 * h * h * width;
}
inline double rounded_min(double a, double b, double width) { return -rounded_max(-a, -b, width); }

/// Distance to the segment a-b with a radius that goes linearly from ra to rb.
inline double capsule(const Vec3& p, const Vec3& a, const Vec3& b, double ra, double rb) {
  const Vec3 ab = b - a;
  const double t = std::clamp((p - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
  return (p - a - t * ab).norm() - (ra + t * (rb - ra));
}

}  // namespace ream::ct
