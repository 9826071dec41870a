#pragma once
#include <vector>

#include "core/progress.hpp"
#include "core/thread_pool.hpp"
#include "solve/elastic_grid.hpp"

namespace ream::solve {

struct SolverLimits {
  double tolerance = 1e-6;  ///< of the residual's length, over that of the first guess
  int max_iterations = 500;
};

struct Solution {
  std::vector<double> displacements_mm;  ///< 3 corners()
  int iterations = 0;
  double relative_residual = 1.0;
  bool converged = false;
};

/// Displacements of a grid for which nothing pushes where nothing is held: conjugate gradients with a
/// multigrid cycle. `guess`: 3 corners(); what is held stays as it is there. Errors: invalid_input
/// for forces that are not finite; unavailable; what `progress` throws.
Solution solve(const ElasticGrid& grid, double poisson, std::vector<double> guess, const SolverLimits& limits,
               ThreadPool& pool, const Progress& progress = no_progress);

}  // namespace ream::solve
