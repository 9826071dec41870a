#include "force/coupling.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/clock.hpp"
#include "core/units.hpp"

namespace ream::force {
namespace {

/// How much harder than the spring over one tick a blocked direction is.
constexpr double blocked_to_spring = 1.0e7;
/// Along the axis, of the mean outward normal: above this the tool is held by bone behind it, not beside or
/// ahead.
constexpr double bone_behind = 0.5;

double at(const Mat6& m, size_t i, size_t j) { return m[6 * i + j]; }

/// Solves m x = b for a symmetric positive definite m by Cholesky without square roots (L D L^T).
Vec6 solve(Mat6 m, Vec6 x) {
  for (size_t j = 0; j < 6; ++j) {
    for (size_t i = j + 1; i < 6; ++i) {
      const double l = at(m, i, j) / at(m, j, j);
      for (size_t k = j + 1; k <= i; ++k) m[6 * i + k] -= l * at(m, k, j);
      x[i] -= l * x[j];
    }
    for (size_t i = j + 1; i < 6; ++i) m[6 * i + j] /= at(m, j, j);
  }
  for (size_t j = 0; j < 6; ++j) x[j] /= at(m, j, j);
  for (size_t j = 6; j-- > 0;)
    for (size_t i = j + 1; i < 6; ++i) x[j] -= at(m, i, j) * x[i];
  return x;
}

/// Moves the part of `from` along `direction` (unit), where it has one that way, over to `to`.
void move_over(const Vec3& direction, Vec6& from, Vec6& to) {
  const double part = from[0] * direction[0] + from[1] * direction[1] + from[2] * direction[2];
  if (part <= 0.0) return;
  for (size_t i = 0; i < 3; ++i) {
    const double share = part * direction[static_cast<Eigen::Index>(i)];
    from[i] -= share;
    to[i] += share;
  }
}

double inertia_kg_mm2(const VirtualMass& mass) {
  return mass.mass_kg * mass.gyration_radius_mm * mass.gyration_radius_mm;
}

double damping_gain(const VirtualMass& mass) {
  return tick_s * mm_s2_per_n_kg / mass.mass_kg * mass.damping_n_s_mm;
}

}  // namespace

CouplingStep couple(const CouplingParameters& p, const Resistance& resistance, const Vec6& delta,
                    double tick_s) noexcept {
  const double k_linear = p.stiffness_n_mm * p.force_scale,
               k_angular = p.angular_stiffness_n_mm_rad * p.force_scale;
  const Vec6 stiffness{k_linear, k_linear, k_linear, k_angular, k_angular, k_angular};

  // What leaves the bone goes without resistance; the rest meets it.
  Vec6 leaving{}, meeting = delta;
  move_over(resistance.outward, meeting, leaving);
  const Vec3 asked(meeting[0], meeting[1], meeting[2]), stretched = clamp_length(asked, p.stretch_max_mm);
  for (size_t i = 0; i < 3; ++i) meeting[i] = stretched[static_cast<Eigen::Index>(i)];

  double guiding_trace = 0.0;
  for (size_t i = 0; i < 3; ++i) guiding_trace += at(resistance.guiding, i, i);
  const double guiding_scale =
      guiding_trace > 0.0 ? blocked_to_spring * k_linear * tick_s / guiding_trace : 0.0;

  Mat6 system{};
  Vec6 right{};
  for (size_t i = 0; i < 6; ++i) {
    for (size_t j = 0; j < 6; ++j)
      system[6 * i + j] = resistance.cutting[6 * i + j] + guiding_scale * resistance.guiding[6 * i + j];
    system[6 * i + i] += stiffness[i] * tick_s;
    right[i] = stiffness[i] * meeting[i] + resistance.pull[i];
  }
  const Vec6 twist = solve(system, right);

  CouplingStep step;
  step.yielded = asked.norm() > p.stretch_max_mm;
  Vec6 stretch{}, slack{};
  for (size_t i = 0; i < 6; ++i) stretch[i] = meeting[i] - twist[i] * tick_s;
  // Moving sideways may leave the spring pulling out: the tool follows that far instead.
  move_over(resistance.outward, stretch, slack);
  for (size_t i = 0; i < 6; ++i) {
    step.tool_motion[i] = leaving[i] + twist[i] * tick_s + slack[i];
    step.wrench_on_tool[i] = stiffness[i] * stretch[i];
  }
  // The matrix knows no sides: normals that differ make it hold on to a tool that is drawn back along a wall.
  // That is not felt, unless the bone lies behind.
  if (resistance.outward.z() < bone_behind) step.wrench_on_tool[2] = std::max(0.0, step.wrench_on_tool[2]);
  return step;
}

void add_friction(const Sliding& sliding, Resistance& resistance) noexcept {
  if (!(sliding.normal_force_n > 0.0)) return;
  const double spin_mm_s = sliding.turn_speed_rad_s * sliding.mean_radius_mm;
  const double speed_mm_s =
      std::max(sticking_speed_mm_s,
               std::sqrt(sliding.along_speed_mm_s * sliding.along_speed_mm_s + spin_mm_s * spin_mm_s));
  const double damping_n_s_mm = sliding.friction * sliding.normal_force_n / speed_mm_s;
  // The point's velocity is v + w x p, its part across n is what rubs: b J^T (1 - n n^T) J.
  const Vec3& n = resistance.outward;
  const Mat3 across = damping_n_s_mm * (Mat3::Identity() - n * n.transpose());
  const Vec3& p = sliding.point_mm;
  Mat3 arm;
  arm << 0.0, p.z(), -p.y(), -p.z(), 0.0, p.x(), p.y(), -p.x(), 0.0;
  const Mat3 mixed = across * arm, turning = arm.transpose() * mixed;
  for (Eigen::Index i = 0; i < 3; ++i)
    for (Eigen::Index j = 0; j < 3; ++j) {
      resistance.cutting[static_cast<size_t>(6 * i + j)] += across(i, j);
      resistance.cutting[static_cast<size_t>(6 * i + 3 + j)] += mixed(i, j);
      resistance.cutting[static_cast<size_t>(6 * (3 + j) + i)] += mixed(i, j);
      resistance.cutting[static_cast<size_t>(6 * (3 + i) + 3 + j)] += turning(i, j);
    }
  resistance.cutting[35] += damping_n_s_mm * sliding.mean_radius_mm * sliding.mean_radius_mm;
}

CouplingParameters coupling_of(const VirtualMass& mass, double force_scale) noexcept {
  // Damping holds the mass back within the tick as free_flight takes it: it stiffens both alike.
  const double per_tick_squared = (1.0 + damping_gain(mass)) / (mm_s2_per_n_kg * tick_s * tick_s);
  return {mass.mass_kg * per_tick_squared, inertia_kg_mm2(mass) * per_tick_squared, force_scale};
}

Vec6 free_flight(const VirtualMass& mass, const Vec6& twist, const Wrench& hand) noexcept {
  const double linear_gain = tick_s * mm_s2_per_n_kg / mass.mass_kg;
  const double angular_gain = tick_s * mm_s2_per_n_kg / inertia_kg_mm2(mass);
  const double slowed = 1.0 / (1.0 + damping_gain(mass));
  Vec6 way{};
  for (size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    way[i] = tick_s * slowed * (twist[i] + linear_gain * hand.force_n[axis]);
    way[3 + i] = tick_s * slowed * (twist[3 + i] + angular_gain * hand.torque_n_mm[axis]);
  }
  return way;
}

}  // namespace ream::force
