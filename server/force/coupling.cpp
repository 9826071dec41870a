#include "force/coupling.hpp"

#include <cstddef>

namespace ream::force {
namespace {

/// How much harder than the spring over one tick a blocked direction is.
constexpr double blocked_to_spring = 1.0e7;

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

double along(const Vec6& v, const Vec3& direction) {
  return v[0] * direction[0] + v[1] * direction[1] + v[2] * direction[2];
}

/// Moves the part of `from` along `direction` (unit), where it has one that way, over to `to`.
void move_over(const Vec3& direction, Vec6& from, Vec6& to) {
  const double part = along(from, direction);
  if (part <= 0.0) return;
  for (size_t i = 0; i < 3; ++i) {
    const double share = part * direction[static_cast<Eigen::Index>(i)];
    from[i] -= share;
    to[i] += share;
  }
}

/// The ways out of the bone in which nothing may hold the tool back: against the mean normal and, where bone
/// lies ahead, backwards along the axis. The resistance matrix knows no such side: normals that differ make
/// it hold on to a tool that slides out along a wall.
std::array<Vec3, 2> ways_out(const Vec3& outward) {
  return {outward, outward.z() < 0.0 ? Vec3(-Vec3::UnitZ()) : outward};
}

}  // namespace

CouplingStep couple(const CouplingParameters& p, const Resistance& resistance, const Vec6& delta,
                    double tick_s) noexcept {
  const double k_linear = p.stiffness_n_mm * p.force_scale,
               k_angular = p.angular_stiffness_n_mm_rad * p.force_scale;
  const Vec6 stiffness{k_linear, k_linear, k_linear, k_angular, k_angular, k_angular};

  // What leaves the bone goes without resistance; the rest meets it.
  const auto outwards = ways_out(resistance.outward);
  Vec6 leaving{}, meeting = delta;
  for (const Vec3& way : outwards) move_over(way, meeting, leaving);

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
    right[i] = stiffness[i] * meeting[i];
  }
  const Vec6 twist = solve(system, right);

  CouplingStep step;
  Vec6 stretch{}, slack{};
  for (size_t i = 0; i < 6; ++i) stretch[i] = meeting[i] - twist[i] * tick_s;
  // Moving sideways may leave the spring pulling out: the tool follows that far instead.
  for (const Vec3& way : outwards) move_over(way, stretch, slack);
  for (size_t i = 0; i < 6; ++i) {
    step.tool_motion[i] = leaving[i] + twist[i] * tick_s + slack[i];
    step.wrench_on_tool[i] = stiffness[i] * stretch[i];
  }
  return step;
}

}  // namespace ream::force
