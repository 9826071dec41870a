#include "solve/rigid_aggregates_cl.hpp"

namespace ream::solve {

RigidAggregatesCl::RigidAggregatesCl(const gpu::Queue& queue, const ElasticGridCl& grid,
                                     const RigidAggregates& aggregates)
    : queue_(queue),
      aggregates_(aggregates),
      corners_(grid.layout.corners),
      program_(queue, "rigid_aggregates.cl"),
      sum_forces_(program_, "sum_forces"),
      add_motions_(program_, "add_motions"),
      motions_(6 * aggregates.count()),
      device_motions_(queue, motions_.size() * sizeof(double)) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  const RigidAggregates::Lists lists = aggregates.lists();
  members_ = gpu::Buffer::copy_of(queue, lists.members);
  begins_ = gpu::Buffer::copy_of(queue, lists.begins);
  of_corner_ = gpu::Buffer::copy_of(queue, lists.of_corner);
  centres_ = gpu::Buffer::copy_of(queue, lists.centres);
  scale_ = gpu::Buffer::copy_of(queue, std::span(&lists.scale, 1));
  sum_forces_.set_all(grid.layout, static_cast<uint32_t>(aggregates.count()), grid.places, grid.held, begins_,
                      members_, centres_, scale_, device_motions_, device_motions_);
  add_motions_.set_all(grid.layout, grid.places, grid.held, of_corner_, centres_, scale_, device_motions_);
}

void RigidAggregatesCl::add_correction(const gpu::Buffer& residual, gpu::Buffer& correction) {
  sum_forces_.set(8, residual);
  sum_forces_.enqueue(queue_, aggregates_.count(), solve_local_size);
  device_motions_.read(queue_, motions_.data(), device_motions_.bytes());
  aggregates_.balance(motions_);
  device_motions_.write(queue_, motions_.data(), device_motions_.bytes());
  add_motions_.set(7, correction);
  add_motions_.enqueue(queue_, corners_, solve_local_size);
}

}  // namespace ream::solve
