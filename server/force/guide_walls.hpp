#pragma once
#include <Eigen/Core>

namespace ream::force {

using Vec2 = Eigen::Vector2d;

/// A tool's axis between the walls of a guide: where it crosses the tool's origin sideways of the guide's
/// axis (mm), and the sideways part of its unit direction.
struct AxisSideways {
  Vec2 origin_mm = Vec2::Zero(), slope = Vec2::Zero();
};

/// Two points of the tool's axis, by their tool frame z, that must keep within `clearance_mm` of the guide's
/// axis.
struct GuideWalls {
  double leading_mm = 0.0, trailing_mm = 0.0;
  double clearance_mm = 0.1;
  double angular_per_linear_mm2 = 1000.0;
};

struct BetweenWalls {
  AxisSideways axis;
  /// Push of the trailing wall on the axis, as displacement (force over linear stiffness), mm.
  Vec2 trailing_push_mm = Vec2::Zero();
  bool free = true;  ///< no wall was in the way: the axis is as it was wanted
};

/// The axis between the walls that is nearest to the wanted one: least |origin shift|^2 +
/// angular_per_linear_mm2 |slope change|^2. A convex problem with one solution; deterministic, bounded work.
BetweenWalls between_walls(const GuideWalls& walls, const AxisSideways& wanted) noexcept;

}  // namespace ream::force
