#pragma once
#include <span>
#include <vector>

#include "core/progress.hpp"
#include "core/thread_pool.hpp"
#include "gpu/queue.hpp"
#include "solve/elastic_grid.hpp"

namespace ream::solve {

struct SolverLimits {
  double tolerance = 1e-6;  ///< of the residual's length, over that of the loads; without, of the first guess
  int max_iterations = 500;
  /// Corners along each edge of the rigid pieces, at least. Small ones help with thin struts; where there are
  /// none, larger ones are sooner prepared.
  int min_piece_corners = 4;
  /// Solves on this OpenCL device, else on the processor: the same bits.
  const gpu::Queue* queue = nullptr;
};

struct Solution {
  std::vector<double> displacements_mm;  ///< 3 corners()
  int iterations = 0;
  double relative_residual = 1.0;
  bool converged = false;
};

/// Displacements of a grid on which `loads_n` (3 corners(), or none: nothing pushes) act where nothing is
/// held: conjugate gradients with a multigrid cycle. `guess`: 3 corners(); what is held stays as it is there.
/// Errors: invalid_input for forces that are not finite; unavailable; what `progress` throws.
Solution solve(const ElasticGrid& grid, double poisson, std::vector<double> guess, const SolverLimits& limits,
               ThreadPool& pool, const Progress& progress = no_progress,
               std::span<const double> loads_n = {});

}  // namespace ream::solve
