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

}  // namespace

CouplingStep couple(const CouplingParameters& p, const Resistance& resistance, const Vec6& delta,
                    double tick_s) noexcept {
  const double k_linear = p.stiffness_n_mm * p.force_scale,
               k_angular = p.angular_stiffness_n_mm_rad * p.force_scale;
  const Vec6 stiffness{k_linear, k_linear, k_linear, k_angular, k_angular, k_angular};

  // What leaves the bone goes without resistance; the rest meets it.
  const double along =
      delta[0] * resistance.outward[0] + delta[1] * resistance.outward[1] + delta[2] * resistance.outward[2];
  Vec6 leaving{}, meeting = delta;
  if (along > 0.0)
    for (size_t i = 0; i < 3; ++i) {
      leaving[i] = along * resistance.outward[static_cast<Eigen::Index>(i)];
      meeting[i] = delta[i] - leaving[i];
    }

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
  for (size_t i = 0; i < 6; ++i) {
    const double advance = twist[i] * tick_s;
    step.tool_motion[i] = leaving[i] + advance;
    step.wrench_on_tool[i] = stiffness[i] * (meeting[i] - advance);
  }
  return step;
}

}  // namespace ream::force
