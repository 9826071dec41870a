#include "force/guide_walls.hpp"

#include <algorithm>
#include <cmath>

namespace ream::force {
namespace {

/// Walls nearer to each other than this are one.
constexpr double one_wall_mm = 1.0e-6;
constexpr double rounding_mm = 1.0e-9;
constexpr int most_turns = 30;

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

Vec2 unit_or_x(const Vec2& v) {
  const double length = v.norm();
  return length > 0.0 ? Vec2(v / length) : Vec2(Vec2::UnitX());
}

Vec2 turned_left(const Vec2& v) { return {-v.y(), v.x()}; }

/// Both points touch: Newton's method for the directions in which they lie on the walls, at which the pushes
/// have no part along the walls.
class BothTouch {
 public:
  BothTouch(const GuideWalls& walls, const Compliance& give, const Vec2& leading, const Vec2& trailing)
      : clearance_(walls.clearance_mm), leading_(leading), trailing_(trailing) {
    const double apart = walls.leading_mm - walls.trailing_mm;
    const double determinant = apart * apart / walls.angular_per_linear_mm2;
    stiff_leading_ = give.trailing / determinant;
    stiff_both_ = -give.both / determinant;
    stiff_trailing_ = give.leading / determinant;
    on_leading_ = unit_or_x(stiff_leading_ * leading + stiff_both_ * trailing);
    on_trailing_ = unit_or_x(stiff_both_ * leading + stiff_trailing_ * trailing);
  }

  void solve() {
    for (int i = 0; i < most_turns; ++i)
      if (turn() < 1.0e-14) return;
  }

  Vec2 leading_push() const {
    return stiff_leading_ * (leading_ - clearance_ * on_leading_) +
           stiff_both_ * (trailing_ - clearance_ * on_trailing_);
  }
  Vec2 trailing_push() const {
    return stiff_both_ * (leading_ - clearance_ * on_leading_) +
           stiff_trailing_ * (trailing_ - clearance_ * on_trailing_);
  }

 private:
  /// One step; how far it turned the directions, squared.
  double turn() {
    const Vec2 push_1 = leading_push(), push_2 = trailing_push();
    const Vec2 along_1 = turned_left(on_leading_), along_2 = turned_left(on_trailing_);
    const double slope_1 = -push_1.dot(along_1), slope_2 = -push_2.dot(along_2);
    const double bend_1 = clearance_ * stiff_leading_ + push_1.dot(on_leading_);
    const double bend_2 = clearance_ * stiff_trailing_ + push_2.dot(on_trailing_);
    const double bend_both = clearance_ * stiff_both_ * along_1.dot(along_2);
    const double determinant = bend_1 * bend_2 - bend_both * bend_both;
    double turn_1, turn_2;
    if (bend_1 > 0.0 && determinant > 0.0) {
      turn_1 = (bend_both * slope_2 - bend_2 * slope_1) / determinant;
      turn_2 = (bend_both * slope_1 - bend_1 * slope_2) / determinant;
    } else {  // away from the minimum: downhill
      turn_1 = -slope_1 / (2.0 * clearance_ * stiff_leading_ + std::abs(bend_1));
      turn_2 = -slope_2 / (2.0 * clearance_ * stiff_trailing_ + std::abs(bend_2));
    }
    turn_1 = std::clamp(turn_1, -0.5, 0.5);
    turn_2 = std::clamp(turn_2, -0.5, 0.5);
    on_leading_ = unit_or_x(on_leading_ + turn_1 * along_1);
    on_trailing_ = unit_or_x(on_trailing_ + turn_2 * along_2);
    return turn_1 * turn_1 + turn_2 * turn_2;
  }

  double clearance_, stiff_leading_, stiff_both_, stiff_trailing_;
  Vec2 leading_, trailing_, on_leading_, on_trailing_;
};

}  // namespace

BetweenWalls between_walls(const GuideWalls& walls, const AxisSideways& wanted) noexcept {
  const double clearance = walls.clearance_mm;
  const Vec2 leading = wanted.origin_mm + walls.leading_mm * wanted.slope;
  const Vec2 trailing = wanted.origin_mm + walls.trailing_mm * wanted.slope;
  const bool one_wall = walls.leading_mm - walls.trailing_mm < one_wall_mm;
  if (leading.norm() <= clearance + rounding_mm && (one_wall || trailing.norm() <= clearance + rounding_mm))
    return {wanted, Vec2::Zero(), true};

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
  found.axis.origin_mm = wanted.origin_mm - leading_push - trailing_push;
  found.axis.slope = wanted.slope - (walls.leading_mm * leading_push + walls.trailing_mm * trailing_push) /
                                        walls.angular_per_linear_mm2;
  found.trailing_push_mm = -trailing_push;
  return found;
}

}  // namespace ream::force
