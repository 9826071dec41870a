#include "force/guide_walls.hpp"

#include <algorithm>
#include <cmath>

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
    for (int i = 0; i < most_steps && miss() > close_enough; ++i)
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
    place(std::max(least_kept * factor_1, factor_1 + change_1),
          std::max(least_kept * factor_2, factor_2 + change_2));
    if (value() > before || (missed < nearly && miss() < missed)) return true;
    place(factor_1, factor_2);
    return false;
  }

  /// Solves for the change of the factors to which the offsets squared react as pushes times `give` times
  /// offsets, less `wanted`.
  bool step(double wanted_1, double wanted_2, int halvings) {
    const double a = (give_.leading + determinant_ * factor_2_) / whole_ * at_1_.squaredNorm();
    const double b = give_.both / whole_ * at_1_.dot(at_2_);
    const double d = (give_.trailing + determinant_ * factor_1_) / whole_ * at_2_.squaredNorm();
    const double determinant = a * d - b * b;
    if (!(determinant > 0.0)) return false;
    double change_1 = (d * wanted_1 - b * wanted_2) / determinant;
    double change_2 = (a * wanted_2 - b * wanted_1) / determinant;
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

  static constexpr int most_steps = 40;
  static constexpr double close_enough = 1.0e-11;
  static constexpr double nearly = 1.0e-3;
  /// A factor falls to no less than this part of itself in a step, so that both stay above 0.
  static constexpr double least_kept = 0.1;

  double clearance_, determinant_ = 0.0, whole_ = 1.0, factor_1_ = 0.0, factor_2_ = 0.0;
  Compliance give_;
  Vec2 leading_, trailing_, at_1_ = Vec2::Zero(), at_2_ = Vec2::Zero();
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
