#include "force/guide.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace ream::force {
namespace {

/// Walls nearer to each other than this are one.
constexpr double one_wall_mm = 1.0e-6;
constexpr double rounding_mm = 1.0e-9;

/// How points of the axis give way to pushes on them: displacement of point i by a push at point j (mm per mm
/// of push), which the spring's linear and angular parts share.
struct Compliance {
  double leading, both, trailing;

  explicit Compliance(const GuideWalls& w)
      : leading(1.0 + w.leading_mm * w.leading_mm / w.angular_per_linear_mm2),
        both(1.0 + w.leading_mm * w.trailing_mm / w.angular_per_linear_mm2),
        trailing(1.0 + w.trailing_mm * w.trailing_mm / w.angular_per_linear_mm2) {}
};

/// `v` shortened to at most `limit`.
Vec2 within(const Vec2& v, double limit) {
  const double length = v.norm();
  return length > limit ? Vec2(v * (limit / length)) : v;
}

/// Both points touch: each wall pushes against its point's offset, in proportion to it. The two factors make
/// the value of the dual problem, which is concave, largest. Newton's method on clearance over offset, which
/// is nearly linear in them, gets there in a few steps; where it does not gain, the dual's own Newton step
/// does, or each wall in turn while the other's push stays.
class BothTouch {
 public:
  BothTouch(const GuideWalls& walls, const Compliance& give, const Vec2& leading, const Vec2& trailing)
      : clearance_(walls.clearance_mm), give_(give), leading_(leading), trailing_(trailing) {
    const double apart = walls.leading_mm - walls.trailing_mm;
    determinant_ = apart * apart / walls.angular_per_linear_mm2;
    // Pushes that bring both points to the guide's axis.
    const Vec2 push_1 = (give.trailing * leading - give.both * trailing) / determinant_;
    const Vec2 push_2 = (give.leading * trailing - give.both * leading) / determinant_;
    place(push_1.norm() / clearance_, push_2.norm() / clearance_);
  }

  void solve() {
    for (int i = 0; i < max_steps && miss() > close_enough; ++i)
      if (!secular_step() && !dual_step()) wall_by_wall();
  }

  Vec2 leading_push() const { return factor_1_ * at_1_; }
  Vec2 trailing_push() const { return factor_2_ * at_2_; }

 private:
  double miss() const {
    return std::max(std::abs(at_1_.norm() - clearance_), std::abs(at_2_.norm() - clearance_)) / clearance_;
  }

  /// Where the points are under pushes of these factors.
  void place(double factor_1, double factor_2) {
    factor_1_ = factor_1;
    factor_2_ = factor_2;
    whole_ = 1.0 + give_.leading * factor_1 + give_.trailing * factor_2 + determinant_ * factor_1 * factor_2;
    at_1_ = ((1.0 + give_.trailing * factor_2) * leading_ - give_.both * factor_2 * trailing_) / whole_;
    at_2_ = ((1.0 + give_.leading * factor_1) * trailing_ - give_.both * factor_1 * leading_) / whole_;
  }

  /// Of the dual problem, doubled.
  double value() const {
    const double squared = clearance_ * clearance_;
    return factor_1_ * (at_1_.dot(leading_) - squared) + factor_2_ * (at_2_.dot(trailing_) - squared);
  }

  /// Changes the factors; takes it back when that does not gain. Near the end the value no longer tells.
  bool gains_by(double change_1, double change_2) {
    const double factor_1 = factor_1_, factor_2 = factor_2_, before = value(), missed = miss();
    place(std::max(min_kept * factor_1, factor_1 + change_1),
          std::max(min_kept * factor_2, factor_2 + change_2));
    if (value() > before || (missed < nearly && miss() < missed)) return true;
    place(factor_1, factor_2);
    return false;
  }

  /// Solves for the change of the factors to which the offsets squared react as pushes times `give` times
  /// offsets, less `desired`.
  bool step(double desired_1, double desired_2, int halvings) {
    const double a = (give_.leading + determinant_ * factor_2_) / whole_ * at_1_.squaredNorm();
    const double b = give_.both / whole_ * at_1_.dot(at_2_);
    const double d = (give_.trailing + determinant_ * factor_1_) / whole_ * at_2_.squaredNorm();
    const double determinant = a * d - b * b;
    if (!(determinant > 0.0)) return false;
    double change_1 = (d * desired_1 - b * desired_2) / determinant;
    double change_2 = (a * desired_2 - b * desired_1) / determinant;
    for (int i = 0; i <= halvings; ++i, change_1 *= 0.5, change_2 *= 0.5)
      if (gains_by(change_1, change_2)) return true;
    return false;
  }

  bool secular_step() {
    const double squared_1 = at_1_.squaredNorm(), squared_2 = at_2_.squaredNorm();
    return step(squared_1 * (std::sqrt(squared_1) / clearance_ - 1.0),
                squared_2 * (std::sqrt(squared_2) / clearance_ - 1.0), 0);
  }

  bool dual_step() {
    const double squared = clearance_ * clearance_;
    return step(0.5 * (at_1_.squaredNorm() - squared), 0.5 * (at_2_.squaredNorm() - squared), 10);
  }

  void wall_by_wall() {
    const Vec2 leading = leading_ - give_.both * trailing_push();
    const Vec2 push_1 = (leading - within(leading, clearance_)) / give_.leading;
    const Vec2 trailing = trailing_ - give_.both * push_1;
    const Vec2 push_2 = (trailing - within(trailing, clearance_)) / give_.trailing;
    place(push_1.norm() / clearance_, push_2.norm() / clearance_);
  }

  static constexpr int max_steps = 40;
  static constexpr double close_enough = 1.0e-11;
  static constexpr double nearly = 1.0e-3;
  /// A factor falls to no less than this part of itself in a step, so that both stay above 0.
  static constexpr double min_kept = 0.1;

  double clearance_, determinant_ = 0.0, whole_ = 1.0, factor_1_ = 0.0, factor_2_ = 0.0;
  Compliance give_;
  Vec2 leading_, trailing_, at_1_ = Vec2::Zero(), at_2_ = Vec2::Zero();
};

/// The rim of the hole is rounded: near full insertion the guided length ends within this part of it to
/// either side, so that the wedging force has no jump.
constexpr double rounding = 0.2;
/// The depth of a wedged tool is sought in such steps, at most so many a tick (1 m/s).
constexpr double seek_step_mm = 0.05;
constexpr int max_seek_steps = 20, max_refinements = 12;
constexpr double steepest_slope = 0.999;

/// A tool's pose as the walls see it.
struct Seen {
  AxisSideways axis;
  double depth_mm = 0.0;  ///< of the leading point below the mouth, as if upright
};

Seen seen(const Guide& guide, const Pose& pose) {
  const Vec3 u = pose.rotation.col(2);
  Vec2 slope(u.x(), u.y());
  // A tool that points backwards is taken as lying across.
  if (u.z() < 0.0) slope = slope.norm() > 0.0 ? Vec2(slope / slope.norm()) : Vec2(Vec2::UnitX());
  return {{Vec2(pose.translation_mm.x(), pose.translation_mm.y()), slope},
          pose.translation_mm.z() + guide.leading_mm - guide.mouth_mm};
}

struct Inserted {
  double length_mm = 0.0, growth = 0.0;  ///< of the length with the depth
};

Inserted inserted(const Guide& guide, double depth_mm) {
  const double begin = (1.0 - rounding) * guide.length_mm, end = (1.0 + rounding) * guide.length_mm;
  if (depth_mm <= 0.0) return {};
  if (depth_mm <= begin) return {depth_mm, 1.0};
  if (depth_mm >= end) return {guide.length_mm, 0.0};
  const double left = end - depth_mm, growth = left / (end - begin);
  return {guide.length_mm - 0.5 * growth * left, growth};
}

BetweenWalls at_depth(const Guide& guide, const AxisSideways& axis, double depth_mm) {
  return between_walls({guide.leading_mm, guide.leading_mm - inserted(guide, depth_mm).length_mm,
                        guide.clearance_mm, guide.angular_per_linear_mm2},
                       axis);
}

/// How much the spring's energy grows with depth, over the linear stiffness (mm), while the handle stays: its
/// axial part and what the mouth does to a tilted tool.
double growth_mm(const Guide& guide, const Seen& handle, double depth_mm) {
  const BetweenWalls between = at_depth(guide, handle.axis, depth_mm);
  return depth_mm - handle.depth_mm +
         inserted(guide, depth_mm).growth * between.trailing_push_mm.dot(between.axis.slope);
}

/// Where the growth changes sign between two depths at which it has different ones: false position, with the
/// weight of an end that stays halved (Illinois).
double refined(const Guide& guide, const Seen& handle, double a_mm, double growth_a, double b_mm,
               double growth_b) {
  for (int i = 0; i < max_refinements && growth_a != growth_b; ++i) {
    const double c_mm = b_mm - growth_b * (b_mm - a_mm) / (growth_b - growth_a);
    const double growth_c = growth_mm(guide, handle, c_mm);
    if (std::abs(growth_c) < 1.0e-10) return c_mm;
    if ((growth_c < 0.0) != (growth_b < 0.0)) {
      a_mm = b_mm;
      growth_a = growth_b;
    } else {
      growth_a *= 0.5;
    }
    b_mm = c_mm;
    growth_b = growth_c;
  }
  return b_mm;
}

/// The depth to which the tool follows the handle: downhill in energy from where it was.
double sought_depth_mm(const Guide& guide, double before_mm, const Seen& handle) {
  const double last = std::min(handle.depth_mm, guide.deepest_mm - guide.mouth_mm);
  if (at_depth(guide, handle.axis, last).trailing_push_mm.squaredNorm() == 0.0) return last;
  double at = std::clamp(before_mm, 0.0, last);
  double growth = growth_mm(guide, handle, at);
  const double step = growth < 0.0 ? seek_step_mm : -seek_step_mm;
  for (int i = 0; i < max_seek_steps; ++i) {
    const double next = std::clamp(at + step, 0.0, last);
    if (next == at) return at;
    const double growth_next = growth_mm(guide, handle, next);
    if ((growth_next < 0.0) != (growth < 0.0)) return refined(guide, handle, at, growth, next, growth_next);
    at = next;
    growth = growth_next;
  }
  return at;
}

/// The least rotation that takes unit vector `a` to unit vector `b`.
Mat3 min_rotation(const Vec3& a, const Vec3& b, const Vec3& across_a) {
  const double cosine = a.dot(b);
  if (cosine < -0.999999) return 2.0 * across_a * across_a.transpose() - Mat3::Identity();
  const Vec3 v = a.cross(b);
  Mat3 cross;
  cross << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return Mat3::Identity() + cross + cross * cross / (1.0 + cosine);
}

/// `pose` with its axis as it is between the walls, at a depth; itself when it is that already.
Pose put(const Pose& pose, const BetweenWalls& between, double shift_z_mm) {
  if (between.free && shift_z_mm == 0.0) return pose;
  Pose placed = pose;
  placed.translation_mm.z() += shift_z_mm;
  if (between.free) return placed;
  placed.translation_mm.x() = between.axis.origin_mm.x();
  placed.translation_mm.y() = between.axis.origin_mm.y();
  Vec2 slope = between.axis.slope;
  const double steepness = slope.norm();
  if (steepness > steepest_slope) slope *= steepest_slope / steepness;
  const Vec3 axis(slope.x(), slope.y(), std::sqrt(1.0 - slope.squaredNorm()));
  placed.rotation =
      orthonormalized(min_rotation(pose.rotation.col(2), axis, pose.rotation.col(0)) * pose.rotation);
  return placed;
}

}  // namespace

BetweenWalls between_walls(const GuideWalls& walls, const AxisSideways& desired) noexcept {
  const double clearance = walls.clearance_mm;
  const Vec2 leading = desired.origin_mm + walls.leading_mm * desired.slope;
  const Vec2 trailing = desired.origin_mm + walls.trailing_mm * desired.slope;
  const bool one_wall = walls.leading_mm - walls.trailing_mm < one_wall_mm;
  if (leading.norm() <= clearance + rounding_mm && (one_wall || trailing.norm() <= clearance + rounding_mm))
    return {desired, Vec2::Zero(), true};

  // Of a convex problem every way to satisfy its conditions is the solution: one wall, the other, or both.
  const Compliance give(walls);
  Vec2 leading_push = (leading - within(leading, clearance)) / give.leading, trailing_push = Vec2::Zero();
  const auto solved = [&] {
    const Vec2 a = leading - give.leading * leading_push - give.both * trailing_push;
    const Vec2 b = trailing - give.both * leading_push - give.trailing * trailing_push;
    return a.norm() <= clearance + rounding_mm && b.norm() <= clearance + rounding_mm;
  };
  if (!one_wall && !solved()) {
    leading_push.setZero();
    trailing_push = (trailing - within(trailing, clearance)) / give.trailing;
    if (!solved()) {
      BothTouch both(walls, give, leading, trailing);
      both.solve();
      leading_push = both.leading_push();
      trailing_push = both.trailing_push();
    }
  }
  BetweenWalls found;
  found.free = false;
  found.axis.origin_mm = desired.origin_mm - leading_push - trailing_push;
  found.axis.slope = desired.slope - (walls.leading_mm * leading_push + walls.trailing_mm * trailing_push) /
                                         walls.angular_per_linear_mm2;
  found.trailing_push_mm = -trailing_push;
  return found;
}

Guide nipple_guide(double radius_mm, double height_mm, double hole_diameter_mm, double hole_depth_mm) {
  Guide guide;
  guide.clearance_mm = 0.5 * hole_diameter_mm - radius_mm;
  if (!(guide.clearance_mm > 0.0))
    throw Error(ErrorKind::conflict, "a nipple of " + std::to_string(2.0 * radius_mm) +
                                         " mm does not fit a pilot hole of " +
                                         std::to_string(hole_diameter_mm) +
                                         " mm; plan a wider hole, another reamer or another guide");
  guide.leading_mm = guide.length_mm = height_mm;
  guide.deepest_mm = hole_depth_mm;
  return guide;
}

Guide pin_guide() {
  Guide guide;
  guide.mouth_mm = -pin_outside_mm;
  guide.length_mm = pin_bore_mm;
  guide.clearance_mm = pin_clearance_mm;
  guide.threaded = true;
  return guide;
}

void follow(const Guide& guide, GuideState& state, const Pose& guide_from_tool) noexcept {
  const Seen tool = seen(guide, guide_from_tool);
  if (tool.depth_mm <= 0.0) state.entered = false;
  const bool through_mouth = !state.begun || state.depth_mm <= 0.0 || tool.depth_mm <= mouth_depth_mm;
  if (!state.entered && tool.depth_mm > 0.0 && through_mouth) {
    const Vec2 leading = tool.axis.origin_mm + guide.leading_mm * tool.axis.slope;
    state.entered = leading.norm() <= guide.clearance_mm || (guide.threaded && !state.begun);
    state.held_mm = guide_from_tool.translation_mm.z();
  }
  state.begun = true;
  state.depth_mm = tool.depth_mm;
}

Pose constrained(const Guide& guide, GuideState& state, const Pose& guide_from_handle) noexcept {
  const Seen handle = seen(guide, guide_from_handle);
  if (!state.entered || handle.depth_mm <= 0.0) return guide_from_handle;
  const double origin_mm = guide.mouth_mm - guide.leading_mm;  // of the tool with its leading point there
  const double depth = sought_depth_mm(guide, state.held_mm - origin_mm, handle);
  state.held_mm = depth + origin_mm;
  return put(guide_from_handle, at_depth(guide, handle.axis, depth), depth - handle.depth_mm);
}

Pose held(const Guide& guide, const GuideState& state, const Pose& guide_from_tool) noexcept {
  const Seen tool = seen(guide, guide_from_tool);
  if (!state.entered || tool.depth_mm <= 0.0) return guide_from_tool;
  const double depth = std::min(tool.depth_mm, guide.deepest_mm - guide.mouth_mm);
  return put(guide_from_tool, at_depth(guide, tool.axis, depth), depth - tool.depth_mm);
}

}  // namespace ream::force
