#include "solve/vectors_cl.hpp"

#include "solve/elastic_operator_cl.hpp"
#include "solve/parallel_vectors.hpp"

namespace ream::solve {

VectorsCl::VectorsCl(const gpu::Queue& queue, size_t count)
    : queue_(queue),
      count_(count),
      program_(queue, "solver_vectors.cl"),
      combine_(program_, "combine"),
      to_floats_(program_, "to_floats"),
      to_doubles_(program_, "to_doubles"),
      sum_products_(program_, "sum_products"),
      sums_((count + numbers_in_part - 1) / numbers_in_part),
      device_sums_(queue, sums_.size() * sizeof(double)) {}

gpu::Buffer VectorsCl::zeros() const {
  gpu::Buffer vector(queue_, count_ * sizeof(double));
  vector.fill(queue_, 0);
  return vector;
}

void VectorsCl::combine(double a, const gpu::Buffer& x, double b, gpu::Buffer& y) {
  combine_.set_all(count_, a, x, b, y);
  combine_.enqueue(queue_, count_, solve_local_size);
}

double VectorsCl::dot(const gpu::Buffer& x, const gpu::Buffer& y) {
  sum_products_.set_all(count_, x, y, device_sums_);
  sum_products_.enqueue(queue_, sums_.size() * sum_lanes, sum_lanes);
  device_sums_.read(queue_, sums_.data(), sums_.size() * sizeof(double));
  double all = 0.0;
  for (const double sum : sums_) all += sum;
  return all;
}

void VectorsCl::to_floats(double scale, const gpu::Buffer& from, gpu::Buffer& to) {
  to_floats_.set_all(count_, scale, from, to);
  to_floats_.enqueue(queue_, count_, solve_local_size);
}

void VectorsCl::to_doubles(double scale, const gpu::Buffer& from, gpu::Buffer& to) {
  to_doubles_.set_all(count_, scale, from, to);
  to_doubles_.enqueue(queue_, count_, solve_local_size);
}

}  // namespace ream::solve
