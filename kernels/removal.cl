#include "common.h"
#include "layout.h"

// Cuts listed bricks by the swept profile. Twin of server/collide/removal_cpu.cpp. LANES work-items a group: 1 where
// work-items are loops (CPU), up to 64 elsewhere. A group takes every G-th brick, its lanes take rows of eight voxels.

#if LANES > 1
#define GROUP_BARRIER barrier(CLK_LOCAL_MEM_FENCE)
#else
#define GROUP_BARRIER
#endif

#define BRICK_EDGE 8
#define BRICK_ROWS 64

// Finalizer of splitmix64, as core/hash.hpp.
static ulong mix64(ulong x) {
  x += 0x9e3779b97f4a7c15ul;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ul;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebul;
  return x ^ (x >> 31);
}

// Coverage that the eight voxels of a row may keep; (fu, fv, fw) are their voxel indices.
static uchar8 kept_in_row(global const float* table, const struct RemovalArguments* p, float8 fu, float fv, float fw) {
  const float* m = p->tool_from_voxel.m;
  const float* t = p->tool_from_voxel.t;
  const float row_x = m[2] * fw + m[1] * fv + t[0];
  const float row_y = m[5] * fw + m[4] * fv + t[1];
  const float row_z = m[8] * fw + m[7] * fv + t[2];
  const float8 x = m[0] * fu + row_x, y = m[3] * fu + row_y, z = m[6] * fu + row_z;
  float8 r = (x * x + y * y) * p->inverse_r2_step;
  r = select((float8)(p->r2_limit), r, r < p->r2_limit);
  float8 h = (z - p->z_min_mm) * p->inverse_z_step;
  h = select((float8)(0.0f), h, h > 0.0f);
  h = select((float8)(p->z_limit), h, h < p->z_limit);
  const int8 ir = convert_int8(r), ih = convert_int8(h);
  const float8 tr = r - convert_float8(ir), th = h - convert_float8(ih);
  int at[8];
  vstore8(ih * p->r2_count + ir, 0, at);
  float low0[8], low1[8], high0[8], high1[8];
  for (int u = 0; u < 8; ++u) {
    low0[u] = table[at[u]];
    low1[u] = table[at[u] + 1];
    high0[u] = table[at[u] + p->r2_count];
    high1[u] = table[at[u] + p->r2_count + 1];
  }
  const float8 a0 = vload8(0, low0), b0 = vload8(0, high0);
  const float8 near_z = a0 + tr * (vload8(0, low1) - a0);
  const float8 far_z = b0 + tr * (vload8(0, high1) - b0);
  float8 level = (near_z + th * (far_z - near_z)) * p->levels_per_mm + 128.0f;
  level = select(level, (float8)(0.0f), level < 0.0f);
  level = select(level, (float8)(255.0f), level > 255.0f);
  return convert_uchar8(convert_int8(level));
}

// What one work-item did to its rows of a brick.
typedef struct {
  ulong hash;
  int removed[3];
  uint changed, left;
} LaneSums;

// Lowers the row of eight voxels that starts at `at` to what it may keep.
static void cut_row(global uchar* coverage, global const uchar* density, global const uchar* classes, size_t at,
                    uchar8 before, uchar8 kept, LaneSums* sums) {
  if (any(kept < before)) {
    uchar old_levels[8], new_levels[8];
    vstore8(before, 0, old_levels);
    vstore8(kept, 0, new_levels);
    for (int u = 0; u < 8; ++u) {
      if (new_levels[u] >= old_levels[u]) continue;
      sums->removed[classes[density[at + u]]] += old_levels[u] - new_levels[u];
      sums->hash += mix64((ulong)(at + u) * 256 + new_levels[u]);
    }
    before = min(before, kept);
    vstore8(before, 0, coverage + at);
    sums->changed = 1;
  }
  sums->left |= as_ulong(before) != 0;
}

static void write_record(local const LaneSums* lanes, global struct RemovalRecord* record) {
  LaneSums all = lanes[0];
  for (int lane = 1; lane < LANES; ++lane) {
    all.hash += lanes[lane].hash;
    for (int k = 0; k < 3; ++k) all.removed[k] += lanes[lane].removed[k];
    all.changed |= lanes[lane].changed;
    all.left |= lanes[lane].left;
  }
  record->hash_low = (uint)all.hash;
  record->hash_high = (uint)(all.hash >> 32);
  for (int k = 0; k < 3; ++k) record->removed[k] = all.removed[k];
  record->changed = all.changed;
  record->left = all.left;
  record->unused = 0;
}

kernel __attribute__((reqd_work_group_size(LANES, 1, 1))) void cut_bricks(
    global uchar* coverage, global const uchar* density, global const uchar* classes, global const float* table,
    global const uint* bricks, struct RemovalArguments arguments, global uchar* slots) {
  local LaneSums lanes[LANES];
  const int lane = get_local_id(0);
  const float8 steps = (float8)(0.0f, 1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f, 7.0f);

  for (uint i = get_group_id(0); i < arguments.bricks; i += get_num_groups(0)) {
    const int brick = (int)bricks[i];
    const int first_u = brick % arguments.brick_dims_x * BRICK_EDGE;
    const int first_v = brick / arguments.brick_dims_x % arguments.brick_dims_y * BRICK_EDGE;
    const int first_w = brick / (arguments.brick_dims_x * arguments.brick_dims_y) * BRICK_EDGE;
    global uchar* slot = slots + (size_t)i * arguments.slot_bytes;
    LaneSums sums = {0, {0, 0, 0}, 0, 0};
    for (int row = lane; row < BRICK_ROWS; row += LANES) {
      const int v = first_v + row % BRICK_EDGE, w = first_w + row / BRICK_EDGE;
      const size_t at = ((size_t)brick * BRICK_ROWS + row) * BRICK_EDGE;
      const uchar8 before = vload8(0, coverage + at);
      if (as_ulong(before) != 0)
        cut_row(coverage, density, classes, at, before,
                kept_in_row(table, &arguments, (float)first_u + steps, (float)v, (float)w), &sums);
      if (arguments.slot_bytes > sizeof(struct RemovalRecord))
        vstore8(vload8(0, coverage + at), row, slot + sizeof(struct RemovalRecord));
    }
    lanes[lane] = sums;
    GROUP_BARRIER;
    if (lane == 0) write_record(lanes, (global struct RemovalRecord*)slot);
    GROUP_BARRIER;
  }
}
