#include "common.h"
#include "layout.h"
#include "elastic_grid.h"

// Twins of what server/solve/multigrid.cpp does on a level: the same operations in the same order, so the same bits.
// A work-item writes one corner's numbers, or one number.

// One, halved for each axis along which there is a step.
static float weight_of(int3 step) {
  return (step.x != 0 ? 0.5f : 1.0f) * (step.y != 0 ? 0.5f : 1.0f) * (step.z != 0 ? 0.5f : 1.0f);
}

static float3 but_held(float3 values, uchar held) {
  if ((held & 1) != 0) values.x = 0.0f;
  if ((held & 2) != 0) values.y = 0.0f;
  if ((held & 4) != 0) values.z = 0.0f;
  return values;
}

// direction = kept direction + scale D^-1 residual, and one step along it.
kernel void step_along(uint count, float kept, float scale, global const float* inverse_diagonal,
                       global const float* residual, global float* direction, global float* solution) {
  const size_t i = get_global_id(0);
  if (i >= count) return;
  const float along = kept * direction[i] + scale * inverse_diagonal[i] * residual[i];
  direction[i] = along;
  solution[i] += along;
}

// Sums of the fine residual about each coarse corner, with the weights of interpolation.
kernel void restrict_residual(struct ElasticGridLayout fine, global const int* fine_corner_of,
                              struct ElasticGridLayout coarse, global const uint* coarse_places,
                              global const uchar* coarse_held, global const float* residual, global float* sums) {
  const size_t corner = get_global_id(0);
  if (corner >= coarse.corners) return;
  const int3 middle = 2 * place_of(coarse, coarse_places[corner]);
  float3 sum = (float3)(0.0f, 0.0f, 0.0f);
  for (int i = 0; i < 27; ++i) {
    const int3 step = (int3)(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1), at = middle + step;
    if (at.x < 0 || at.y < 0 || at.z < 0 || at.x > fine.dims_x || at.y > fine.dims_y || at.z > fine.dims_z) continue;
    const int near = fine_corner_of[lattice_index(fine, at)];
    if (near >= 0) sum += weight_of(step) * vload3((size_t)near, residual);
  }
  vstore3(but_held(sum, coarse_held[corner]), corner, sums);
}

// direction = the coarse solution, trilinear between its corners; and one step along it.
kernel void step_by_coarse(struct ElasticGridLayout coarse, global const int* coarse_corner_of,
                           struct ElasticGridLayout fine, global const uint* fine_places,
                           global const uchar* fine_held, global const float* coarse_solution,
                           global float* direction, global float* solution) {
  const size_t corner = get_global_id(0);
  if (corner >= fine.corners) return;
  const int3 at = place_of(fine, fine_places[corner]), low = at / 2, odd = at - 2 * low;
  const float weight = weight_of(odd);
  float3 sum = (float3)(0.0f, 0.0f, 0.0f);
  for (int c = 0; c < 8; ++c) {
    const int3 step = (int3)(c & 1, c >> 1 & 1, c >> 2);
    if (step.x > odd.x || step.y > odd.y || step.z > odd.z) continue;
    sum += weight * vload3((size_t)coarse_corner_of[lattice_index(coarse, low + step)], coarse_solution);
  }
  const float3 along = but_held(sum, fine_held[corner]);
  vstore3(along, corner, direction);
  vstore3(vload3(corner, solution) + along, corner, solution);
}
