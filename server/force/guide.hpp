#pragma once
#include <Eigen/Core>

#include "geometry/pose.hpp"

namespace ream::force {

/// A rod on the tool's axis in a straight hole, or a bore around a fixed pin: two points of the tool's axis
/// may leave the guide's axis sideways by no more than the clearance, the leading point and the one `inserted
/// length` behind it. Guide frame: origin at the mouth of the planned hole, z along its axis into the bone.
struct Guide {
  double leading_mm = 0.0;    ///< leading point on the tool's axis, tool frame z
  double mouth_mm = 0.0;      ///< where the leading point goes in, guide frame z
  double length_mm = 8.0;     ///< guided when wholly in
  double clearance_mm = 0.1;  ///< above 0
  double deepest_mm = 1.0e6;  ///< the leading point gets no deeper, guide frame z
  bool threaded = false;  ///< a tool that begins past the mouth begins in the guide, wherever it is sideways
  /// Angular over linear stiffness of the spring between handle and tool: which of two poses is nearer.
  double angular_per_linear_mm2 = 1000.0;
};

/// What a guide remembers from tick to tick.
struct GuideState {
  bool begun = false;     ///< the tool has been seen
  bool entered = false;   ///< the tool is in the guide
  double depth_mm = 0.0;  ///< of the tool's leading point below the mouth, when last seen
  double held_mm = 0.0;   ///< guide frame z of the last constrained pose
};
/// Cannulated reamer on a guide pin: radial clearance, length of the bore, and how far the pin stands out of
/// the bone. Engineering choices.
inline constexpr double pin_clearance_mm = 0.1, pin_bore_mm = 30.0, pin_outside_mm = 80.0;
/// A tool whose leading point meets the mouth this deep or less has still come in through it.
inline constexpr double mouth_depth_mm = 1.0;

/// A nipple in a pilot hole that begins at the guide frame's origin. Error conflict when it does not fit.
Guide nipple_guide(double radius_mm, double height_mm, double hole_diameter_mm, double hole_depth_mm);

/// A cannulated reamer on a pin along the guide's axis. Somebody has threaded it before the session begins; a
/// hand that begins beside the pin has not paid for the spring that this has drawn, so that the energy guard
/// lets it feel less than the spring until it has.
Guide pin_guide();

/// To be told after every tick where the tool is: it enters when its leading point passes the mouth within
/// the clearance (or begins inside, or threaded), and leaves when it is lifted out. A tool that missed the
/// mouth is not guided until it is lifted and put in.
void follow(const Guide& guide, GuideState& state, const Pose& guide_from_tool) noexcept;

/// The pose nearest to the handle that the guide allows, nearest by the energy of the spring between them, so
/// that the spring's force is conservative and normal to the guide's walls: it never holds the tool back
/// along the axis and never pulls it in. A tool held tilted goes no deeper than the mouth lets it. The handle
/// itself when the tool is not in the guide, or when nothing is in its way. Only + - x / and square root; no
/// allocation; bounded work.
Pose constrained(const Guide& guide, GuideState& state, const Pose& guide_from_handle) noexcept;

/// The tool put back between the walls at the depth it has.
Pose held(const Guide& guide, const GuideState& state, const Pose& guide_from_tool) noexcept;

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
BetweenWalls between_walls(const GuideWalls& walls, const AxisSideways& desired) noexcept;

}  // namespace ream::force
