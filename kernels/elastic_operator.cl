#include "common.h"
#include "layout.h"

// Twin of server/solve/elastic_operator.cpp, where the method is explained: the same operations in the same order, so
// the same bits. A work-item sums the forces on one corner. Each element is worked on once for each of its corners, so
// that no two work-items write to one place.

#ifdef DOUBLES
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
typedef double real;
typedef double3 real3;
#else
typedef float real;
typedef float3 real3;
#endif

// From the place of an element's corner 0 to that of corner c.
static uint offset_of(struct ElasticGridLayout grid, uint c) {
  return (c & 1u) + (c >> 1 & 1u) * grid.row + (c >> 2 & 1u) * grid.layer;
}

// Sums and differences over the element's corners: its modes.
static void to_modes(real3* values) {
#pragma unroll
  for (uint bit = 1; bit < 8; bit *= 2)
#pragma unroll
    for (uint c = 0; c < 8; ++c)
      if ((c & bit) == 0) {
        const real3 low = values[c], high = values[c | bit];
        values[c] = low + high;
        values[c | bit] = low - high;
      }
}

static void multiply_blocks(constant real* blocks, real3* modes) {
#pragma unroll
  for (uint parity = 0; parity < 8; ++parity) {
    constant real* b = blocks + 9 * parity;
    const real u = modes[parity ^ 1].x, v = modes[parity ^ 2].y, w = modes[parity ^ 4].z;
    modes[parity ^ 1].x = b[0] * u + b[1] * v + b[2] * w;
    modes[parity ^ 2].y = b[3] * u + b[4] * v + b[5] * w;
    modes[parity ^ 4].z = b[6] * u + b[7] * v + b[8] * w;
  }
}

// Of corner c alone. Multiplying by a sign is exact: low + -high is low - high.
static real3 from_modes(const real3* modes, uint c) {
  const real by_x = (c & 1u) != 0 ? -1 : 1, by_y = (c & 2u) != 0 ? -1 : 1, by_z = (c & 4u) != 0 ? -1 : 1;
  const real3 low = (modes[0] + by_x * modes[1]) + by_y * (modes[2] + by_x * modes[3]);
  const real3 high = (modes[4] + by_x * modes[5]) + by_y * (modes[6] + by_x * modes[7]);
  return low + by_z * high;
}

// `moduli_mpa` begins with an element's offset_of(7) of nothing. forces = stiffness * displacements, or with
// `take_off` what was there less that.
kernel void apply_stiffness(struct ElasticGridLayout grid, global const uint* places, global const int* corner_of,
                            global const float* moduli_mpa, global const uchar* held, constant real* blocks,
                            int take_off, global const real* displacements, global real* forces) {
  const size_t corner = get_global_id(0);
  if (corner >= grid.corners) return;
  const uint place = places[corner];
  // Elements of even layers come first, then those of odd ones; in a layer, one row after the other.
  const uint first_corner = (place / grid.layer & 1u) != 0 ? 7 : 3;
  real3 sum = (real3)(0, 0, 0);
  for (uint i = 0; i < 8; ++i) {
    const uint c = first_corner ^ i;
    const real modulus = moduli_mpa[place + offset_of(grid, 7u ^ c)];
    if (modulus == 0) continue;
    const uint first = place - offset_of(grid, c);
    real3 values[8];
#pragma unroll
    for (uint d = 0; d < 8; ++d) values[d] = vload3((size_t)corner_of[first + offset_of(grid, d)], displacements);
    to_modes(values);
    multiply_blocks(blocks, values);
    sum += from_modes(values, c) * modulus;
  }
  const uchar fixed = held[corner];
  if ((fixed & 1) != 0) sum.x = 0;
  if ((fixed & 2) != 0) sum.y = 0;
  if ((fixed & 4) != 0) sum.z = 0;
  vstore3(take_off ? vload3(corner, forces) - sum : sum, corner, forces);
}
