#include "common.h"
#include "layout.h"
#include "elastic_grid.h"
#pragma OPENCL EXTENSION cl_khr_fp64 : enable

// Twins of the loops over corners in server/solve/rigid_aggregates.cpp: the same operations in the same order, so the
// same bits.

static double3 arm_of(struct ElasticGridLayout grid, uint place, global const double* centre, constant double* scale) {
  return (convert_double3(place_of(grid, place)) - vload3(0, centre)) * (double3)(scale[0], scale[1], scale[2]);
}

static double3 but_held(double3 values, uchar held) {
  if ((held & 1) != 0) values.x = 0.0;
  if ((held & 2) != 0) values.y = 0.0;
  if ((held & 4) != 0) values.z = 0.0;
  return values;
}

// The built-in function may be rounded otherwise.
static double3 cross_of(double3 a, double3 b) {
  return (double3)(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

// Forces on an aggregate and moments about its centre; a work-item each.
kernel void sum_forces(struct ElasticGridLayout grid, uint aggregates, global const uint* places,
                       global const uchar* held, global const uint* begins, global const uint* members,
                       global const double* centres, constant double* scale, global const double* residual,
                       global double* sums) {
  const size_t aggregate = get_global_id(0);
  if (aggregate >= aggregates) return;
  double3 force = (double3)(0.0, 0.0, 0.0), moment = force;
  for (uint i = begins[aggregate]; i < begins[aggregate + 1]; ++i) {
    const size_t corner = members[i];
    const double3 arm = arm_of(grid, places[corner], centres + 3 * aggregate, scale);
    const double3 f = but_held(vload3(corner, residual), held[corner]);
    force += f;
    moment += cross_of(arm, f);
  }
  vstore3(force, 2 * aggregate, sums);
  vstore3(moment, 2 * aggregate + 1, sums);
}

// What the motions of aggregates add to a correction; a work-item for each corner.
kernel void add_motions(struct ElasticGridLayout grid, global const uint* places, global const uchar* held,
                        global const uint* of_corner, global const double* centres, constant double* scale,
                        global const double* motions, global double* correction) {
  const size_t corner = get_global_id(0);
  if (corner >= grid.corners) return;
  const size_t aggregate = of_corner[corner];
  const double3 arm = arm_of(grid, places[corner], centres + 3 * aggregate, scale);
  const double3 moved = vload3(2 * aggregate, motions) + cross_of(vload3(2 * aggregate + 1, motions), arm);
  vstore3(vload3(corner, correction) + but_held(moved, held[corner]), corner, correction);
}
