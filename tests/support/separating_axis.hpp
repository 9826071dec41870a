#pragma once
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/vec.hpp"

namespace ream::test {

/// Independent reference, in doubles: whether a triangle meets the cube of half edge `half` around the
/// origin, by the 13 axes along which two such bodies can be apart. Every axis is held against all three
/// corners, so that an axis that rounding has turned can only miss a gap, never invent one.
class TriangleAxes {
 public:
  explicit TriangleAxes(const std::array<Vec3, 3>& corners) : corners_(corners) {
    const std::array<Vec3, 3> edges = {corners[1] - corners[0], corners[2] - corners[1],
                                       corners[0] - corners[2]};
    size_t i = 0;
    for (int k = 0; k < 3; ++k) add(Vec3::Unit(k), i);
    add(edges[0].cross(edges[1]), i);
    for (const Vec3& edge : edges)
      for (int k = 0; k < 3; ++k) add(edge.cross(Vec3::Unit(k)), i);
  }

  /// Largest gap between triangle and cube around `centre` along any of the axes, measured as the growth of
  /// the cube's half edge that would close it; negative where they meet with room to spare. Any gap above
  /// `enough` may be told as soon as it is found.
  double gap(const Vec3& centre, double enough = 1e300, double half = 0.5) const {
    double worst = -1e300;
    for (const Axis& axis : axes_) {
      if (axis.reach == 0.0) continue;
      const double at = axis.direction.dot(centre);
      worst = std::max(worst, std::max(axis.low - at, at - axis.high) / axis.reach - half);
      if (worst > enough) break;
    }
    return worst;
  }

  const std::array<Vec3, 3>& corners() const { return corners_; }

 private:
  struct Axis {
    Vec3 direction = Vec3::Zero();
    double low = 0.0, high = 0.0;  ///< of the triangle
    double reach = 0.0;            ///< of the unit cube's half edge
  };
  void add(const Vec3& direction, size_t& i) {
    Axis& axis = axes_[i++];
    const double longest = direction.cwiseAbs().maxCoeff();
    if (longest == 0.0) return;
    axis.direction = direction / longest;
    const double a = axis.direction.dot(corners_[0]), b = axis.direction.dot(corners_[1]),
                 c = axis.direction.dot(corners_[2]);
    axis.low = std::min({a, b, c});
    axis.high = std::max({a, b, c});
    axis.reach = axis.direction.cwiseAbs().sum();
  }

  std::array<Vec3, 3> corners_;
  std::array<Axis, 13> axes_;
};

}  // namespace ream::test
