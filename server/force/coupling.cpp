#include "force/coupling.hpp"

#include <algorithm>
#include <cstddef>

#include "force/limits.hpp"

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

}  // namespace

CouplingStep couple(const CouplingParameters& p, const Resistance& resistance, const Vec6& delta,
                    double tick_s) noexcept {
  const double k_linear = p.stiffness_n_mm * p.force_scale,
               k_angular = p.angular_stiffness_n_mm_rad * p.force_scale;
  const Vec6 stiffness{k_linear, k_linear, k_linear, k_angular, k_angular, k_angular};

  // What leaves the bone goes without resistance; the rest meets it.
  Vec6 leaving{}, meeting = delta;
  move_over(resistance.outward, meeting, leaving);
  const Vec3 asked(meeting[0], meeting[1], meeting[2]), stretched = limited(asked, p.stretch_max_mm);
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
    right[i] = stiffness[i] * meeting[i];
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
  // That is not felt.
  if (resistance.outward.z() < 0.0) step.wrench_on_tool[2] = std::max(0.0, step.wrench_on_tool[2]);
  return step;
}

}  // namespace ream::force
