#include "common.h"
#include "layout.h"
#pragma OPENCL EXTENSION cl_khr_fp64 : enable

// Vectors of conjugate gradients. Twins of server/solve/conjugate_gradients.cpp and parallel_vectors.hpp: the same bits.

kernel void combine(ulong count, double a, global const double* x, double b, global double* y) {
  const size_t i = get_global_id(0);
  if (i < count) y[i] = a * x[i] + b * y[i];
}

kernel void to_floats(ulong count, double scale, global const double* from, global float* to) {
  const size_t i = get_global_id(0);
  if (i < count) to[i] = (float)(scale * from[i]);
}

kernel void to_doubles(ulong count, double scale, global const float* from, global double* to) {
  const size_t i = get_global_id(0);
  if (i < count) to[i] = scale * (double)from[i];
}

// A work-group sums a part: each lane every so many numbers, then the lanes by halves.
kernel __attribute__((reqd_work_group_size(REAM_SOLVE_LANES, 1, 1))) void sum_products(ulong count,
                                                                                        global const double* x,
                                                                                        global const double* y,
                                                                                        global double* sums) {
  local double lanes[REAM_SOLVE_LANES];
  const size_t lane = get_local_id(0), begin = get_group_id(0) * REAM_SOLVE_PART;
  const size_t end = min((size_t)count, begin + REAM_SOLVE_PART);
  double sum = 0.0;
  for (size_t i = begin + lane; i < end; i += REAM_SOLVE_LANES) sum += x[i] * y[i];
  lanes[lane] = sum;
  for (size_t left = REAM_SOLVE_LANES / 2; left > 0; left /= 2) {
    barrier(CLK_LOCAL_MEM_FENCE);
    if (lane < left) lanes[lane] += lanes[lane + left];
  }
  if (lane == 0) sums[get_group_id(0)] = lanes[0];
}
