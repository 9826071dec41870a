#include "common.h"
#include "layout.h"

// Contact sums of the shell's surviving blocks. Twin of server/collide/narrow_phase_cpu.cpp. LANES work-items a group: 1
// where work-items are loops (CPU), a multiple of the warp elsewhere. A group takes every G-th block; its lanes take
// chunks of 16 points, decode them as one vector, and add what the engaged ones contribute.

#if LANES > 1
#define GROUP_BARRIER barrier(CLK_LOCAL_MEM_FENCE)
#define ADD_TO_RUN(index, value) atomic_add(&run_sums[index], value)
#else
#define GROUP_BARRIER
#define ADD_TO_RUN(index, value) run_sums[index] += value
#endif

#define NO_VOXEL 0xffffffffu

// Voxel index of sixteen probes, NO_VOXEL outside the grid and beyond `remaining`, and the occupancy cells they lie in.
static void find_voxels(float16 x, float16 y, float16 z, int remaining, const struct ContactArguments* a, uint* voxels,
                        uint* cells) {
  const float* m = a->voxel_from_tool.m;
  const float* t = a->voxel_from_tool.t;
  const float16 u = m[0] * x + m[1] * y + m[2] * z + t[0];
  const float16 v = m[3] * x + m[4] * y + m[5] * z + t[1];
  const float16 w = m[6] * x + m[7] * y + m[8] * z + t[2];
  const int16 lane = (int16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  const int16 inside = (u >= 0.0f) & (v >= 0.0f) & (w >= 0.0f) & (u < (float)a->dims_x) & (v < (float)a->dims_y) &
                       (w < (float)a->dims_z) & (lane < remaining);
  const uint16 iu = convert_uint16(convert_int16(select((float16)(0.0f), u, inside)));
  const uint16 iv = convert_uint16(convert_int16(select((float16)(0.0f), v, inside)));
  const uint16 iw = convert_uint16(convert_int16(select((float16)(0.0f), w, inside)));
  const uint row = (uint)a->dims_x;
  const uint16 brick = iu / 8 + iv / 8 * (row / 8) + iw / 8 * (row / 8 * ((uint)a->dims_y / 8));
  const uint cell_row = row / REAM_OCCUPANCY_EDGE, cell_slice = cell_row * ((uint)a->dims_y / REAM_OCCUPANCY_EDGE);
  vstore16(select((uint16)(NO_VOXEL), brick * 512 + iu % 8 + iv % 8 * 8 + iw % 8 * 64, inside), 0, voxels);
  vstore16(iu / REAM_OCCUPANCY_EDGE + iv / REAM_OCCUPANCY_EDGE * cell_row + iw / REAM_OCCUPANCY_EDGE * cell_slice, 0,
           cells);
}

// The 7 x 8 products of one side, kept in registers.
#define DECLARE_PRODUCTS(s) int8 s##0 = 0, s##1 = 0, s##2 = 0, s##3 = 0, s##4 = 0, s##5 = 0, s##6 = 0
#define ADD_PRODUCTS(s, wg, g) \
  s##0 += wg.s0 * g; s##1 += wg.s1 * g; s##2 += wg.s2 * g; s##3 += wg.s3 * g; \
  s##4 += wg.s4 * g; s##5 += wg.s5 * g; s##6 += wg.s6 * g
#define ADD_ROW(row, first) \
  ADD_TO_RUN(first, row.s0); ADD_TO_RUN(first + 1, row.s1); ADD_TO_RUN(first + 2, row.s2); ADD_TO_RUN(first + 3, row.s3); \
  ADD_TO_RUN(first + 4, row.s4); ADD_TO_RUN(first + 5, row.s5); ADD_TO_RUN(first + 6, row.s6)
#define ADD_PART(s, part) \
  ADD_ROW(s##0, part); ADD_ROW(s##1, part + 8); ADD_ROW(s##2, part + 16); ADD_ROW(s##3, part + 24); \
  ADD_ROW(s##4, part + 32); ADD_ROW(s##5, part + 40); ADD_ROW(s##6, part + 48)

kernel __attribute__((reqd_work_group_size(LANES, 1, 1))) void contact_sums(
    global const float* probe_x, global const float* probe_y, global const float* probe_z, global const short* vectors,
    global const uchar* weights, global const uchar* guiding, global const struct ContactBlock* blocks,
    global const uint* survivors, global const uint* occupancy, global const uchar* coverage,
    global const uchar* density, global const uchar* classes, struct ContactArguments arguments, global long* partial) {
  local int run_sums[REAM_CONTACT_SUMS];
  const int lane = get_local_id(0);
  global long* sums = partial + (size_t)get_group_id(0) * REAM_CONTACT_SUMS;
  for (int k = lane; k < REAM_CONTACT_SUMS; k += LANES) {
    sums[k] = 0;
    run_sums[k] = 0;
  }
  GROUP_BARRIER;

  for (uint s = get_group_id(0); s < arguments.survivors; s += get_num_groups(0)) {
    const struct ContactBlock block = blocks[survivors[s]];
    for (uint run = 0; run < block.count; run += REAM_CONTACT_RUN) {
      const uint run_end = min(block.count, run + REAM_CONTACT_RUN);
      DECLARE_PRODUCTS(cut);
      DECLARE_PRODUCTS(guide);
      int points = 0, guided = 0;
      for (uint chunk = run + lane * REAM_CONTACT_CHUNK; chunk < run_end; chunk += LANES * REAM_CONTACT_CHUNK) {
        const uint first = block.first + chunk;
        uint at[REAM_CONTACT_CHUNK], cell[REAM_CONTACT_CHUNK];
        find_voxels(vload16(0, probe_x + first), vload16(0, probe_y + first), vload16(0, probe_z + first),
                    (int)(run_end - chunk), &arguments, at, cell);
        for (int k = 0; k < REAM_CONTACT_CHUNK; ++k) {
          if (at[k] == NO_VOXEL || !(occupancy[cell[k] / 32] >> cell[k] % 32 & 1)) continue;
          if (coverage[at[k]] < REAM_ENGAGING_COVERAGE) continue;
          const int8 g = convert_int8(vload8(first + k, vectors));
          const int8 wg = (int)weights[first + k] * g;
          if (guiding[first + k]) {
            ADD_PRODUCTS(guide, wg, g);
            ++guided;
          } else {
            ADD_PRODUCTS(cut, wg, g);
            ++points;
            const int code = density[at[k]];
            ADD_TO_RUN(REAM_CONTACT_CLASS_POINTS + classes[code], 1);
            ADD_TO_RUN(REAM_CONTACT_CLASS_DENSITY + classes[code], code);
          }
        }
      }
      if (points != 0) {
        ADD_PART(cut, REAM_CONTACT_CUTTING);
        ADD_TO_RUN(REAM_CONTACT_CUTTING_POINTS, points);
      }
      if (guided != 0) {
        ADD_PART(guide, REAM_CONTACT_GUIDING);
        ADD_TO_RUN(REAM_CONTACT_GUIDING_POINTS, guided);
      }
      GROUP_BARRIER;
      for (int k = lane; k < REAM_CONTACT_SUMS; k += LANES) {
        sums[k] += run_sums[k];
        run_sums[k] = 0;
      }
      GROUP_BARRIER;
    }
  }
}
