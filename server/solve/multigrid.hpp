#pragma once
#include <memory>
#include <span>
#include <vector>

#include "core/thread_pool.hpp"
#include "solve/elastic_grid.hpp"

namespace ream::solve {

class DirectSolution;

/// One V-cycle of geometric multigrid on ever coarser grids, in single precision: nearly the inverse of a
/// grid's stiffness, and symmetric, as conjugate gradients want it (after Flaig and Arbenz 2012, who solve
/// bone so). Smoothed by Chebyshev polynomials of the operator over its diagonal; the coarsest grid is solved
/// directly.
class Multigrid {
 public:
  /// `finest` and `pool` must outlive this.
  Multigrid(const ElasticGrid& finest, double poisson, ThreadPool& pool);
  ~Multigrid();
  Multigrid(const Multigrid&) = delete;
  Multigrid& operator=(const Multigrid&) = delete;

  /// correction = cycle(residual), 3 corners() each. Both any scale that is finite.
  void cycle(std::span<const double> residual, std::span<double> correction);

  size_t levels() const { return levels_.size(); }

 private:
  struct Level;

  ThreadPool& pool_;
  const std::vector<std::unique_ptr<ElasticGrid>> coarser_;
  std::vector<std::unique_ptr<Level>> levels_;
  std::unique_ptr<DirectSolution> coarsest_;
};

}  // namespace ream::solve
