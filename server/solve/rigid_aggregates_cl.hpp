#pragma once
#include "solve/elastic_operator_cl.hpp"
#include "solve/rigid_aggregates.hpp"

namespace ream::solve {

/// RigidAggregates for vectors in the memory of a device: the same bits. Aggregates are balanced on the
/// processor: six numbers of each come and go.
class RigidAggregatesCl {
 public:
  /// All must outlive this; the device must know doubles. Errors: unavailable.
  RigidAggregatesCl(const gpu::Queue& queue, const ElasticGridCl& grid, const RigidAggregates& aggregates);

  void add_correction(const gpu::Buffer& residual, gpu::Buffer& correction);

 private:
  const gpu::Queue& queue_;
  const RigidAggregates& aggregates_;
  size_t corners_;
  gpu::Program program_;
  gpu::Kernel sum_forces_, add_motions_;
  std::vector<double> motions_;
  gpu::Buffer members_, begins_, of_corner_, centres_, scale_, device_motions_;
};

}  // namespace ream::solve
