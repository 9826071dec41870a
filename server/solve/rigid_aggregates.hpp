#pragma once
#include <memory>
#include <span>

#include "core/progress.hpp"
#include "core/thread_pool.hpp"
#include "solve/elastic_grid.hpp"

namespace ream::solve {

/// What coarse cells cannot tell of thin bone: struts side by side move apart, and bend. Corners in one block
/// of the lattice that hang together there form an aggregate, which moves and turns as one; what such motions
/// leave is solved directly. (As aggregation does
/// it: P. Arbenz et al., A scalable multi-level preconditioner for matrix-free micro-finite element analysis
/// of human bone structures, Int. J. Numer. Meth. Engng 73, 2008.)
class RigidAggregates {
 public:
  /// `grid` must outlive this. Errors: unavailable; what `progress` throws.
  /// `min_edge`: places of the lattice along each edge of a block, at least.
  RigidAggregates(const ElasticGrid& grid, double poisson, int min_edge = 4,
                  const Progress& progress = no_progress);
  ~RigidAggregates();
  RigidAggregates(const RigidAggregates&) = delete;
  RigidAggregates& operator=(const RigidAggregates&) = delete;

  /// correction += the motions of aggregates that balance `residual`, 3 corners() each.
  void add_correction(std::span<const double> residual, std::span<double> correction, ThreadPool& pool) const;

  size_t count() const;
  /// Forces on each aggregate and moments about its centre, 6 count(), become the motions that balance them.
  void balance(std::span<double> motions) const;

  /// For a device. Valid while this is.
  struct Lists {
    /// Corners by aggregate, and where those of each begin; the aggregate of each corner.
    std::span<const uint32_t> members, begins, of_corner;
    std::span<const Vec3> centres;  ///< on the lattice
    Vec3 scale;                     ///< of a corner's place beside its centre: moments are of arms so scaled
  };
  Lists lists() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace ream::solve
