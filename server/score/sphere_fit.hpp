#pragma once
#include <optional>
#include <span>

#include "geometry/vec.hpp"

namespace ream::score {

struct FittedSphere {
  Vec3 centre_mm = Vec3::Zero();
  double radius_mm = 0.0;
  double mean_deviation_mm = 0.0;  ///< mean |distance from the centre - radius|
};

/// The sphere with least squares of distance to the points. Empty for fewer than 12 points, points of a plane
/// or a line, or a radius over 500 mm.
std::optional<FittedSphere> fit_sphere(std::span<const Vec3> points_mm);

/// Unit normal, z positive, of the plane z = a + b x + c y that fits the points by Huber's loss: squares up
/// to `bound_mm`, linear beyond, so that a few points that lie elsewhere turn it little, and no choice of
/// points makes it jump (Huber, Annals of Mathematical Statistics 35, 1964). Empty for fewer than three
/// points or points over a line.
std::optional<Vec3> fit_depth_plane(std::span<const Vec3> points_mm, double bound_mm);

}  // namespace ream::score
