#pragma once
#include "gpu/program.hpp"

namespace ream::solve {

/// What conjugate gradients do with vectors of `count` doubles in the memory of a device: the same bits as on
/// the processor. All but dot() is enqueued, not waited for.
class VectorsCl {
 public:
  /// `queue` must outlive this; its device must know doubles. Errors: unavailable.
  VectorsCl(const gpu::Queue& queue, size_t count);

  gpu::Buffer zeros() const;
  /// y = a x + b y.
  void combine(double a, const gpu::Buffer& x, double b, gpu::Buffer& y);
  /// As sum_of (parallel_vectors.hpp).
  double dot(const gpu::Buffer& x, const gpu::Buffer& y);
  /// to = scale from, of single precision.
  void to_floats(double scale, const gpu::Buffer& from, gpu::Buffer& to);
  void to_doubles(double scale, const gpu::Buffer& from, gpu::Buffer& to);

 private:
  const gpu::Queue& queue_;
  uint64_t count_;
  gpu::Program program_;
  gpu::Kernel combine_, to_floats_, to_doubles_, sum_products_;
  std::vector<double> sums_;
  gpu::Buffer device_sums_;
};

}  // namespace ream::solve
