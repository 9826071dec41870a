#include "solve/conjugate_gradients.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "solve/elastic_operator.hpp"
#include "solve/multigrid.hpp"
#include "solve/parallel_vectors.hpp"
#include "solve/rigid_aggregates.hpp"

namespace ream::solve {
namespace {

using Doubles = std::vector<double>;

class ConjugateGradients {
 public:
  ConjugateGradients(const ElasticGrid& grid, double poisson, Doubles guess, ThreadPool& pool,
                     const Progress& progress)
      : stiffness_(grid, poisson),
        multigrid_(grid, poisson, pool),
        aggregates_(grid, poisson, progress),
        pool_(pool) {
    solution_.displacements_mm = std::move(guess);
    for (Doubles* vector : {&residual_, &corrected_, &direction_, &forces_})
      vector->resize(solution_.displacements_mm.size());
  }

  Solution run(const SolverLimits& limits, const Progress& progress) {
    stiffness_.apply(solution_.displacements_mm, residual_, pool_);
    each([&](size_t i) { residual_[i] = -residual_[i]; });
    const double first = length();
    if (!std::isfinite(first))
      throw Error(ErrorKind::invalid_input, "the bone's forces are not finite; its moduli are too large");
    if (first > 0.0) take_out_rigid_motions();
    solution_.relative_residual = first > 0.0 ? length() / first : 0.0;
    double last_product = 0.0;
    while (solution_.relative_residual > limits.tolerance && solution_.iterations < limits.max_iterations) {
      progress(done(limits.tolerance), "solving");
      precondition();
      const double product = dot(residual_, corrected_);
      const double kept = last_product > 0.0 ? product / last_product : 0.0;
      each([&](size_t i) { direction_[i] = corrected_[i] + kept * direction_[i]; });
      last_product = product;
      if (!advance(product)) break;
      solution_.relative_residual = length() / first;
      ++solution_.iterations;
    }
    solution_.converged = solution_.relative_residual <= limits.tolerance;
    return std::move(solution_);
  }

 private:
  /// The residual's part among the aggregates' motions goes first; the rest stays out of them all along
  /// (A-DEF2 of Tang et al. 2009).
  void take_out_rigid_motions() {
    Doubles& displacements = solution_.displacements_mm;
    aggregates_.add_correction(residual_, corrected_, pool_);
    stiffness_.apply(corrected_, forces_, pool_);
    each([&](size_t i) {
      displacements[i] += corrected_[i];
      residual_[i] -= forces_[i];
    });
  }

  /// corrected = V r + Q (r - A V r), V the multigrid cycle and Q the aggregates.
  void precondition() {
    multigrid_.cycle(residual_, corrected_);
    stiffness_.apply(corrected_, forces_, pool_);
    each([&](size_t i) { forces_[i] = residual_[i] - forces_[i]; });
    aggregates_.add_correction(forces_, corrected_, pool_);
  }

  /// False where rounding leaves nowhere to go.
  bool advance(double product) {
    stiffness_.apply(direction_, forces_, pool_);
    const double curvature = dot(direction_, forces_);
    if (!(curvature > 0.0) || !(product > 0.0) || !std::isfinite(product / curvature)) return false;
    const double step = product / curvature;
    Doubles& displacements = solution_.displacements_mm;
    each([&](size_t i) {
      displacements[i] += step * direction_[i];
      residual_[i] -= step * forces_[i];
    });
    return true;
  }

  template <typename Work>
  void each(Work work) {
    for_parts(pool_, residual_.size(), [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) work(i);
    });
  }
  double dot(const Doubles& a, const Doubles& b) {
    return sum_of(pool_, a.size(), [&](size_t i) { return a[i] * b[i]; });
  }
  double length() { return std::sqrt(dot(residual_, residual_)); }
  double done(double tolerance) const {
    return std::clamp(std::log(solution_.relative_residual) / std::log(tolerance), 0.0, 1.0);
  }

  ElasticOperator<double> stiffness_;
  Multigrid multigrid_;
  RigidAggregates aggregates_;
  ThreadPool& pool_;
  Doubles residual_, corrected_, direction_, forces_;
  Solution solution_;
};

}  // namespace

Solution solve(const ElasticGrid& grid, double poisson, Doubles guess, const SolverLimits& limits,
               ThreadPool& pool, const Progress& progress) {
  return ConjugateGradients(grid, poisson, std::move(guess), pool, progress).run(limits, progress);
}

}  // namespace ream::solve
