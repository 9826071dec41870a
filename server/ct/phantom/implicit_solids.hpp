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

/// Around the segment a-b, with a radius that goes linearly from ra to rb.
struct Capsule {
  Capsule(const Vec3& a, const Vec3& b, double ra, double rb)
      : from(a), along(b - a), squared_length(along.squaredNorm()), radius(ra), widening(rb - ra) {}

  /// Distance to it; negative within it.
  double value(const Vec3& p) const {
    const double t = std::clamp((p - from).dot(along) / squared_length, 0.0, 1.0);
    return (p - from - t * along).norm() - (radius + t * widening);
  }

  Vec3 from, along;
  double squared_length, radius, widening;
};

inline double capsule(const Vec3& p, const Vec3& a, const Vec3& b, double ra, double rb) {
  return Capsule(a, b, ra, rb).value(p);
}

/// Smooth step between knots: value at `x` of a piecewise curve with flat tangents at its knots.
template <size_t N>
double eased(const double (&at)[N], const double (&value)[N], double x) {
  if (x <= at[0]) return value[0];
  for (size_t i = 1; i < N; ++i)
    if (x < at[i]) {
      const double t = (x - at[i - 1]) / (at[i] - at[i - 1]);
      return value[i - 1] + (value[i] - value[i - 1]) * t * t * (3.0 - 2.0 * t);
    }
  return value[N - 1];
}

}  // namespace ream::ct
