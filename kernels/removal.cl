#include "common.h"
#include "layout.h"
#include "bone_parts.h"

// Cuts listed bricks by the swept profile. Twin of server/collide/removal/removal.cpp. LANES work-items a group: 1 where
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

// Levels of the eight voxels of a row (brick_levels() of profile_table.cpp); (fu, fv, fw) are their voxel indices.
static float8 row_levels(global const int* pairs, const struct RemovalArguments* p, float8 fu, float fv, float fw) {
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
  int near_pairs[8], far_pairs[8];
  for (int u = 0; u < 8; ++u) {
    near_pairs[u] = pairs[at[u]];
    far_pairs[u] = pairs[at[u] + p->r2_count];
  }
  const int8 near_pair = vload8(0, near_pairs), far_pair = vload8(0, far_pairs);
  const float8 near_0 = convert_float8(near_pair << 16 >> 16), near_1 = convert_float8(near_pair >> 16);
  const float8 far_0 = convert_float8(far_pair << 16 >> 16), far_1 = convert_float8(far_pair >> 16);
  const float8 near_z = near_0 + tr * (near_1 - near_0);
  const float8 far_z = far_0 + tr * (far_1 - far_0);
  return (near_z + th * (far_z - near_z)) * p->levels_per_step + 128.0f;
}

static uchar8 kept_coverage(float8 level) {
  level = select(level, (float8)(0.0f), level < 0.0f);
  level = select(level, (float8)(255.0f), level > 255.0f);
  return convert_uchar8(convert_int8(level));
}

// What one work-item did to its rows of a brick.
typedef struct {
  ulong hash;
  int removed[3];
  uint changed;
  float slack;
} LaneSums;

static float smaller(float a, float b) { return a < b ? a : b; }

// Lowers the row of eight voxels from voxel `at` on, whose bytes are given, to what it may keep.
static void cut_row(global uchar* coverage, global const uchar* density, global const uchar* classes, size_t at,
                    uchar8 before, float8 levels, LaneSums* sums) {
  const uchar8 kept = kept_coverage(levels);
  if (any(kept < before)) {
    uchar old_levels[8], new_levels[8];
    vstore8(before, 0, old_levels);
    vstore8(kept, 0, new_levels);
    for (int u = 0; u < 8; ++u) {
      if (new_levels[u] >= old_levels[u]) continue;
      sums->removed[classes[density[u]]] += old_levels[u] - new_levels[u];
      sums->hash += mix64((ulong)(at + u) * 256 + new_levels[u]);
    }
    before = min(before, kept);
    vstore8(before, 0, coverage);
    sums->changed = 1;
  }
  float8 above = levels - convert_float8(before);
  above = select(above, (float8)(REAM_UNTOUCHED_LEVELS), convert_int8(before) == 0);
  float slack[8];
  vstore8(above, 0, slack);
  for (int u = 0; u < 8; ++u) sums->slack = smaller(slack[u], sums->slack);
}

static void write_record(local const LaneSums* lanes, global struct RemovalRecord* record) {
  LaneSums all = lanes[0];
  for (int lane = 1; lane < LANES; ++lane) {
    all.hash += lanes[lane].hash;
    for (int k = 0; k < 3; ++k) all.removed[k] += lanes[lane].removed[k];
    all.changed |= lanes[lane].changed;
    all.slack = smaller(lanes[lane].slack, all.slack);
  }
  record->hash_low = (uint)all.hash;
  record->hash_high = (uint)(all.hash >> 32);
  for (int k = 0; k < 3; ++k) record->removed[k] = all.removed[k];
  record->changed = all.changed;
  record->slack_levels = all.slack;
  record->unused = 0;
}

kernel __attribute__((reqd_work_group_size(LANES, 1, 1))) void cut_bricks(
    global const uchar* classes, global const int* pairs, global const uint* bricks, struct RemovalArguments arguments,
    global uchar* slots, BONE_PARTS(global uchar, coverage), BONE_PARTS(global const uchar, density)) {
  local LaneSums lanes[LANES];
  const int lane = get_local_id(0);
  const float8 steps = (float8)(0.0f, 1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f, 7.0f);

  for (uint i = get_group_id(0); i < arguments.bricks; i += get_num_groups(0)) {
    const int brick = (int)bricks[i];
    const int first_u = brick % arguments.brick_dims_x * BRICK_EDGE;
    const int first_v = brick / arguments.brick_dims_x % arguments.brick_dims_y * BRICK_EDGE;
    const int first_w = brick / (arguments.brick_dims_x * arguments.brick_dims_y) * BRICK_EDGE;
    global uchar* slot = slots + (size_t)i * arguments.slot_bytes;
    LaneSums sums = {0, {0, 0, 0}, 0, REAM_UNTOUCHED_LEVELS};
    for (int row = lane; row < BRICK_ROWS; row += LANES) {
      const int v = first_v + row % BRICK_EDGE, w = first_w + row / BRICK_EDGE;
      const size_t at = ((size_t)brick * BRICK_ROWS + row) * BRICK_EDGE;
      global uchar* row_coverage = AT_VOXEL(coverage, at);
      const uchar8 before = vload8(0, row_coverage);
      if (as_ulong(before) != 0)
        cut_row(row_coverage, AT_VOXEL(density, at), classes, at, before,
                row_levels(pairs, &arguments, (float)first_u + steps, (float)v, (float)w), &sums);
      if (arguments.slot_bytes > sizeof(struct RemovalRecord))
        vstore8(vload8(0, row_coverage), row, slot + sizeof(struct RemovalRecord));
    }
    lanes[lane] = sums;
    GROUP_BARRIER;
    if (lane == 0) write_record(lanes, (global struct RemovalRecord*)slot);
    GROUP_BARRIER;
  }
}
