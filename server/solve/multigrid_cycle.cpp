#include "solve/multigrid_cycle.hpp"

#include <algorithm>

namespace ream::solve {
namespace {

/// So few corners are solved directly.
constexpr size_t max_coarsest_corners = 500;
constexpr int smoothing_steps = 3;
/// Eigenvalues from the greatest down to this share of it are smoothed: what is below, the next grid sees.
constexpr double smoothed_share = 0.05;

}  // namespace

std::vector<std::unique_ptr<ElasticGrid>> coarser_grids(const ElasticGrid& finest, double poisson) {
  const std::array<float, 256> energy_shares = BoxElement(finest.cell_mm(), poisson).energy_shares();
  std::vector<std::unique_ptr<ElasticGrid>> grids;
  for (const ElasticGrid* last = &finest; last->corners() > max_coarsest_corners; last = grids.back().get())
    grids.push_back(std::make_unique<ElasticGrid>(last->coarser(energy_shares)));
  return grids;
}

DirectSolution::DirectSolution(const ElasticGrid& grid, double poisson) {
  const ElasticOperator<float> operator_of_grid(grid, poisson);
  const std::vector<float> inverse_diagonal = operator_of_grid.inverse_diagonal();
  const auto count = static_cast<Eigen::Index>(3 * grid.corners());
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(count, count);
  ThreadPool one(1);
  std::vector<float> unit(3 * grid.corners(), 0.0f), column(3 * grid.corners());
  for (Eigen::Index i = 0; i < count; ++i) {
    unit[static_cast<size_t>(i)] = 1.0f;
    operator_of_grid.apply(unit, column, one);
    unit[static_cast<size_t>(i)] = 0.0f;
    for (Eigen::Index j = 0; j < count; ++j) stiffness(j, i) = double{column[static_cast<size_t>(j)]};
  }
  // What nobody holds may move as a whole; rounding makes nothing of it.
  const double greatest = std::max(stiffness.diagonal().maxCoeff(), 1e-30);
  for (Eigen::Index i = 0; i < count; ++i)
    if (inverse_diagonal[static_cast<size_t>(i)] == 0.0f) {
      stiffness.row(i).setZero();
      stiffness.col(i).setZero();
      stiffness(i, i) = greatest;
    } else {
      stiffness(i, i) += 1e-7 * greatest;
    }
  factors_.compute(stiffness);
}

std::vector<float> DirectSolution::of(std::span<const float> residual) const {
  Eigen::VectorXd right(static_cast<Eigen::Index>(residual.size()));
  for (size_t i = 0; i < residual.size(); ++i) right[static_cast<Eigen::Index>(i)] = double{residual[i]};
  const Eigen::VectorXd found = factors_.solve(right);
  std::vector<float> solution(residual.size());
  for (size_t i = 0; i < solution.size(); ++i)
    solution[i] = static_cast<float>(found[static_cast<Eigen::Index>(i)]);
  return solution;
}

std::vector<ChebyshevStep> chebyshev_steps(double greatest) {
  const double low = smoothed_share * greatest, middle = 0.5 * (greatest + low),
               half = 0.5 * (greatest - low), sigma = middle / half;
  double rho = 1.0 / sigma;
  std::vector<ChebyshevStep> steps{{0.0f, static_cast<float>(1.0 / middle)}};
  for (int i = 1; i < smoothing_steps; ++i) {
    const double next = 1.0 / (2.0 * sigma - rho);
    steps.push_back({static_cast<float>(next * rho), static_cast<float>(2.0 * next / half)});
    rho = next;
  }
  return steps;
}

}  // namespace ream::solve
