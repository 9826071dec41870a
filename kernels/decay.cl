#include "common.h"
#include "layout.h"
#include "bone_parts.h"

// Finds the points of the shell that lie in bone (algorithm 4.1). Twin of server/collide/removal/decay.cpp. A group takes
// every G-th listed run, its LANES work-items take the run's points. What the points take from their voxels is
// subtracted on the host, where the order is one of many with the same result.

kernel __attribute__((reqd_work_group_size(LANES, 1, 1))) void find_hits(
    global const float* points_x, global const float* points_y, global const float* points_z,
    global const struct DecayRunLayout* runs, global const uint* listed, struct DecayArguments arguments,
    global uint* hits, BONE_PARTS(global const uchar, coverage)) {
  const float* m = arguments.voxel_from_tool.m;
  const float* t = arguments.voxel_from_tool.t;
  const int brick_row = arguments.dims_x / 8, brick_slice = brick_row * (arguments.dims_y / 8);
  for (uint i = get_group_id(0); i < arguments.listed; i += get_num_groups(0)) {
    const struct DecayRunLayout run = runs[listed[i]];
    for (uint k = get_local_id(0); k < REAM_DECAY_RUN_POINTS; k += LANES) {
      uint hit = REAM_NO_VOXEL;
      if (k < run.count) {
        const float x = points_x[run.first + k], y = points_y[run.first + k], z = points_z[run.first + k];
        const float u = m[0] * x + m[1] * y + m[2] * z + t[0];
        const float v = m[3] * x + m[4] * y + m[5] * z + t[1];
        const float w = m[6] * x + m[7] * y + m[8] * z + t[2];
        if (u >= 0.0f && v >= 0.0f && w >= 0.0f && u < (float)arguments.dims_x && v < (float)arguments.dims_y &&
            w < (float)arguments.dims_z) {
          const int iu = (int)u, iv = (int)v, iw = (int)w;
          const int brick = (iu >> 3) + (iv >> 3) * brick_row + (iw >> 3) * brick_slice;
          const uint voxel = (uint)brick * 512u + (uint)((iu & 7) + (iv & 7) * 8 + (iw & 7) * 64);
          if (*AT_VOXEL(coverage, voxel) != 0) hit = voxel;
        }
      }
      hits[(size_t)i * REAM_DECAY_RUN_POINTS + k] = hit;
    }
  }
}

// Takes bricks that the host has lowered to a device with memory of its own: 64 rows of eight voxels each.
kernel void put_bricks(global const uint* bricks, global const uchar* images, uint count,
                       BONE_PARTS(global uchar, coverage)) {
  const uint row = get_global_id(0);
  if (row >= count * 64u) return;
  vstore8(vload8(row, images), 0, AT_VOXEL(coverage, (size_t)bricks[row / 64] * 512u + row % 64 * 8));
}
