#pragma once
#include "gpu/program.hpp"
#include "kernels/layout.h"
#include "solve/elastic_operator.hpp"

namespace ream::solve {

/// Work-items of a work-group; the kernels pay no heed to it.
inline constexpr size_t solve_local_size = 64;

/// A grid in the memory of a device, put there once.
struct ElasticGridCl {
  /// `queue` must outlive this. Errors: unavailable.
  ElasticGridCl(const gpu::Queue& queue, const ElasticGrid& grid);

  layout::ElasticGridLayout layout;
  /// Lattice indices of the corners; the corner of each place, or -1; what is held of each corner, in bits.
  gpu::Buffer places, corner_of, held;
  /// Of the element whose corner 0 is at each place, 0 where there is none; before them as many zeros as it
  /// is from corner 0 to corner 7.
  gpu::Buffer moduli_mpa;
};

/// ElasticOperator on an OpenCL device: the same bits.
template <typename Real>
class ElasticOperatorCl {
 public:
  /// All must outlive this but for `twin`, the same on the processor. Errors: unavailable, also for doubles
  /// where the device has none.
  ElasticOperatorCl(const gpu::Queue& queue, const gpu::Program& program, const ElasticGridCl& grid,
                    const ElasticOperator<Real>& twin);
  /// The program for this precision.
  static gpu::Program program(const gpu::Queue& queue);

  /// forces = stiffness * displacements, 3 corners() each; enqueued, not waited for.
  void apply(const gpu::Buffer& displacements, gpu::Buffer& forces) { enqueue(displacements, forces, 0); }
  /// from -= stiffness * displacements.
  void take_off(const gpu::Buffer& displacements, gpu::Buffer& from) { enqueue(displacements, from, 1); }

 private:
  void enqueue(const gpu::Buffer& displacements, gpu::Buffer& forces, int32_t take_off);

  const gpu::Queue& queue_;
  size_t corners_;
  gpu::Buffer blocks_;
  gpu::Kernel kernel_;
};

extern template class ElasticOperatorCl<float>;
extern template class ElasticOperatorCl<double>;

}  // namespace ream::solve
