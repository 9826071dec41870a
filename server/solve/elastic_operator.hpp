#pragma once
#include <span>
#include <vector>

#include "core/thread_pool.hpp"
#include "solve/box_element.hpp"
#include "solve/elastic_grid.hpp"

namespace ream::solve {

/// The stiffness of a grid, never stored: each element's is its modulus times that of one box. The same bits
/// on every number of threads.
template <typename Real>
class ElasticOperator {
 public:
  /// `grid` must outlive this.
  ElasticOperator(const ElasticGrid& grid, double poisson);

  /// forces = stiffness * displacements, N and mm, 3 corners() each; nothing where a corner is held.
  void apply(std::span<const Real> displacements, std::span<Real> forces, ThreadPool& pool) const;
  /// The same with the forces that hold what is held.
  void apply_with_reactions(std::span<const Real> displacements, std::span<Real> forces,
                            ThreadPool& pool) const;

  /// One over the diagonal; 0 where a corner is held.
  std::vector<Real> inverse_diagonal() const;
  /// No eigenvalue of the stiffness over its diagonal is above this.
  double greatest_over_diagonal() const { return greatest_; }
  const ElasticGrid& grid() const { return grid_; }
  /// BoxElement's, rounded.
  const std::array<std::array<Real, 9>, 8>& blocks() const { return blocks_; }

 private:
  const ElasticGrid& grid_;
  Vec3 diagonal_;
  double greatest_;
  std::array<std::array<Real, 9>, 8> blocks_;
  std::array<uint32_t, 8> offsets_;
};

extern template class ElasticOperator<float>;
extern template class ElasticOperator<double>;

}  // namespace ream::solve
