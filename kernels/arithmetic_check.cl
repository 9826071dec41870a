#include "common.h"

// Proves that the compiler neither contracts a * b + c nor reorders a sum: compared with C++ bit by bit.
kernel void multiply_then_add(global const float* a, global const float* b, global const float* c, global float* sums,
                              uint count) {
  const uint i = get_global_id(0);
  if (i < count) sums[i] = a[i] * b[i] + c[i];
}

kernel void sum_in_order(global const float* a, global const float* b, global const float* c, global float* sums,
                         uint count) {
  const uint i = get_global_id(0);
  if (i < count) sums[i] = a[i] * b[i] - (a[i] - c[i]) * (b[i] + c[i]) + c[i] * 0.1f;
}
