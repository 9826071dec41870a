#include "common.h"
#include "layout.h"

// One work-item a triangle (thesis algorithm 3.1). Twin of server/shell/surface_voxelizer_cpu.cpp: the same
// float operations in the same order. Coordinates are in cells; all tests are written around cell centres, which turns
// eqs 3.2, 3.4 and 3.6-3.8 into |d| <= reach and d >= -reach.

// One edge projected on a principal plane (eq. 3.3): normal (na, nb), a point on it, and how far a cell centre may lie
// behind it.
typedef struct {
  float na, nb, va, vb, reach;
} Edge;

// A triangle prepared for its cells, in cells from `base`; its bounding box touches the cells low..high.
typedef struct {
  int base[3], low[3], high[3];
  float v[3][3], e[3][3], n[3];
  float extent, plane_reach;
  Edge xy[3], yz[3], zx[3];
} Prepared;

static float larger(float a, float b) { return a > b ? a : b; }
static float magnitude(float a) { return a < 0.0f ? -a : a; }

static int floor_to_int(float x, float low, float high) {
  if (!(x > low)) return (int)low;
  if (!(x < high)) return (int)high;
  const int whole = (int)x;
  return (float)whole > x ? whole - 1 : whole;
}

static float largest_reach(float a, float b, float c, int thin) {
  return thin ? 0.5f * larger(larger(a, b), c) : 0.5f * ((a + b) + c);
}

static void place(Prepared* t, global const float* corner, const int* dims) {
  t->extent = 0.0f;
  for (int k = 0; k < 3; ++k) {
    const float a = corner[k], b = corner[3 + k], c = corner[6 + k];
    const float least = a < b ? (a < c ? a : c) : (b < c ? b : c);
    const float most = a > b ? (a > c ? a : c) : (b > c ? b : c);
    t->base[k] = floor_to_int(least, -1.0f, (float)dims[k]);
    t->low[k] = (float)t->base[k] == least ? t->base[k] - 1 : t->base[k];
    t->high[k] = floor_to_int(most, -1.0f, (float)dims[k]);
    if (t->low[k] < 0) t->low[k] = 0;
    if (t->high[k] > dims[k] - 1) t->high[k] = dims[k] - 1;
    const float origin = (float)t->base[k];
    t->v[0][k] = a - origin;
    t->v[1][k] = b - origin;
    t->v[2][k] = c - origin;
    t->e[0][k] = t->v[1][k] - t->v[0][k];
    t->e[1][k] = t->v[2][k] - t->v[1][k];
    t->e[2][k] = t->v[0][k] - t->v[2][k];
    t->extent = larger(t->extent, most - least);
  }
}

static Edge projected_edge(const Prepared* t, int i, int a, int b, float facing, int thin) {
  const float size = t->extent + 2.0f, flat_area = t->extent * t->extent;
  const float sign = facing >= 0.0f ? 1.0f : -1.0f;
  Edge edge = {-t->e[i][b] * sign, t->e[i][a] * sign, t->v[i][a], t->v[i][b], 0.0f};
  const float na = magnitude(edge.na), nb = magnitude(edge.nb);
  edge.reach = largest_reach(na, nb, 0.0f, thin) + (size * (na + nb) + flat_area) * REAM_VOXELIZER_EDGE_MARGIN;
  return edge;
}

static void prepare_tests(Prepared* t, int thin) {
  const float size = t->extent + 2.0f, flat_area = t->extent * t->extent;
  t->n[0] = t->e[0][1] * t->e[1][2] - t->e[0][2] * t->e[1][1];
  t->n[1] = t->e[0][2] * t->e[1][0] - t->e[0][0] * t->e[1][2];
  t->n[2] = t->e[0][0] * t->e[1][1] - t->e[0][1] * t->e[1][0];
  const float ax = magnitude(t->n[0]), ay = magnitude(t->n[1]), az = magnitude(t->n[2]);
  t->plane_reach = largest_reach(ax, ay, az, thin) +
                   size * (((ax + ay) + az) * REAM_VOXELIZER_EDGE_MARGIN + flat_area * REAM_VOXELIZER_PLANE_MARGIN);
  for (int i = 0; i < 3; ++i) {
    t->xy[i] = projected_edge(t, i, 0, 1, t->n[2], thin);
    t->yz[i] = projected_edge(t, i, 1, 2, t->n[0], thin);
    t->zx[i] = projected_edge(t, i, 2, 0, t->n[1], thin);
  }
}

static void mark_row(const Prepared* t, float y, float z, global uint* words) {
  float line_offset[6];
  for (int i = 0; i < 3; ++i) {
    if (!(t->yz[i].na * (y - t->yz[i].va) + (t->yz[i].nb * (z - t->yz[i].vb) + t->yz[i].reach) >= 0.0f)) return;
    line_offset[i] = t->xy[i].nb * (y - t->xy[i].vb) + t->xy[i].reach;
    line_offset[3 + i] = t->zx[i].na * (z - t->zx[i].va) + t->zx[i].reach;
  }
  const float plane_offset = t->n[1] * (y - t->v[0][1]) + t->n[2] * (z - t->v[0][2]);
  uint bits = 0;
  for (int u = t->low[0]; u <= t->high[0]; ++u) {
    const float x = (float)(u - t->base[0]) + 0.5f;
    const float d = t->n[0] * (x - t->v[0][0]) + plane_offset;
    if (d <= t->plane_reach && -d <= t->plane_reach) {
      int inside = 1;
      for (int i = 0; i < 3; ++i) {
        inside &= t->xy[i].na * (x - t->xy[i].va) + line_offset[i] >= 0.0f;
        inside &= t->zx[i].nb * (x - t->zx[i].vb) + line_offset[3 + i] >= 0.0f;
      }
      bits |= (uint)inside << (u & 31);
    }
    if ((u & 31) == 31 || u == t->high[0]) {
      if (bits != 0) atomic_or(&words[u >> 5], bits);
      bits = 0;
    }
  }
}

kernel void voxelize_surface(global const float* corners, struct SurfaceVoxelizerArguments grid, global uint* words) {
  const uint triangle = get_global_id(0);
  if (triangle >= grid.triangles) return;
  const int dims[3] = {grid.dims_x, grid.dims_y, grid.dims_z};
  Prepared t;
  place(&t, corners + (size_t)triangle * REAM_VOXELIZER_FLOATS_PER_TRIANGLE, dims);
  prepare_tests(&t, grid.thin);
  for (int w = t.low[2]; w <= t.high[2]; ++w)
    for (int v = t.low[1]; v <= t.high[1]; ++v)
      mark_row(&t, (float)(v - t.base[1]) + 0.5f, (float)(w - t.base[2]) + 0.5f,
               words + (size_t)grid.words_per_row * ((size_t)v + (size_t)grid.dims_y * (size_t)w));
}
