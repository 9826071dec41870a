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

struct FittedPlane {
  Vec3 middle_mm = Vec3::Zero(), normal = Vec3::UnitZ();  ///< unit, of either sign
};

/// The plane with least squares of distance. Empty for fewer than three points or points of a line.
std::optional<FittedPlane> fit_plane(std::span<const Vec3> points_mm);

}  // namespace ream::score
