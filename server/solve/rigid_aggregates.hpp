#pragma once
#include <memory>
#include <span>

#include "core/thread_pool.hpp"
#include "solve/elastic_grid.hpp"

namespace ream::solve {

/// What coarse cells cannot tell of thin bone: struts side by side move apart, and bend. Corners in one block
/// of the lattice that hang together there form an aggregate, which moves and turns as one; what such motions
/// leave is solved directly. (As aggregation does it in Arbenz et al. 2008, for the bone of micro-CT.)
class RigidAggregates {
 public:
  /// `grid` must outlive this.
  RigidAggregates(const ElasticGrid& grid, double poisson);
  ~RigidAggregates();
  RigidAggregates(const RigidAggregates&) = delete;
  RigidAggregates& operator=(const RigidAggregates&) = delete;

  /// correction += the motions of aggregates that balance `residual`, 3 corners() each.
  void add_correction(std::span<const double> residual, std::span<double> correction, ThreadPool& pool) const;

  size_t count() const;
  size_t bytes() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace ream::solve
