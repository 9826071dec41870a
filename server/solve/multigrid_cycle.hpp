#pragma once
#include <Eigen/Cholesky>
#include <memory>
#include <span>
#include <vector>

#include "solve/elastic_operator.hpp"

namespace ream::solve {

/// Ever coarser grids until few corners are left, without the first of them: `finest`.
std::vector<std::unique_ptr<ElasticGrid>> coarser_grids(const ElasticGrid& finest, double poisson);

/// A grid of few corners, solved directly.
class DirectSolution {
 public:
  DirectSolution(const ElasticGrid& grid, double poisson);
  /// The displacements for these forces, 3 corners() each.
  std::vector<float> of(std::span<const float> residual) const;

 private:
  Eigen::LDLT<Eigen::MatrixXd> factors_;
};

/// What a step of smoothing keeps of the last direction, and how far it follows the residual.
struct ChebyshevStep {
  float kept, scale;
};
std::vector<ChebyshevStep> chebyshev_steps(double greatest_eigenvalue);

/// Improves the solution of a level, whose residual is kept up; leaves that of what it became where it is
/// needed. `Level`: `steps`, step(), take_off().
template <class Level>
void smooth(Level& level, bool residual_is_needed) {
  for (const ChebyshevStep& step : level.steps) {
    if (&step != level.steps.data()) level.take_off();
    level.step(step);
  }
  if (residual_is_needed) level.take_off();
}

/// One V-cycle: finds the solution for the residual of the first level. `Level`, on the processor or on a
/// device, has further clear(), restrict_to(), step_by() and solve().
template <class Level>
void descend(std::span<const std::unique_ptr<Level>> levels, const DirectSolution& coarsest) {
  Level& level = *levels.front();
  if (levels.size() == 1) return level.solve(coarsest);
  level.clear();
  smooth(level, true);
  Level& coarse = *levels[1];
  level.restrict_to(coarse);
  descend(levels.subspan(1), coarsest);
  level.step_by(coarse);
  level.take_off();
  smooth(level, false);
}

}  // namespace ream::solve
