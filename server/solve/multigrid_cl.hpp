#pragma once
#include <memory>
#include <span>
#include <vector>

#include "core/thread_pool.hpp"
#include "solve/elastic_operator_cl.hpp"
#include "solve/vectors_cl.hpp"

namespace ream::solve {

class DirectSolution;

/// Multigrid on an OpenCL device: the same bits. Grids and vectors of all levels stay there; of the coarsest,
/// residual and solution come and go.
class MultigridCl {
 public:
  /// `queue`, `finest` and `pool` must outlive this. Errors: unavailable, also where the device has too
  /// little memory, for conjugate gradients too where it knows doubles, or flushes small floats to zero.
  MultigridCl(const gpu::Queue& queue, const ElasticGrid& finest, double poisson, ThreadPool& pool);
  ~MultigridCl();
  MultigridCl(const MultigridCl&) = delete;
  MultigridCl& operator=(const MultigridCl&) = delete;

  /// As Multigrid::cycle.
  void cycle(std::span<const double> residual, std::span<double> correction);
  /// The same of vectors on the device, which knows doubles.
  void cycle(const gpu::Buffer& residual, gpu::Buffer& correction, VectorsCl& vectors);

  const ElasticGridCl& finest() const;

 private:
  struct Level;
  struct Programs;

  const gpu::Queue& queue_;
  ThreadPool& pool_;
  const std::vector<std::unique_ptr<ElasticGrid>> coarser_;
  std::unique_ptr<Programs> programs_;
  std::vector<std::unique_ptr<Level>> levels_;
  std::unique_ptr<DirectSolution> coarsest_;
};

}  // namespace ream::solve
