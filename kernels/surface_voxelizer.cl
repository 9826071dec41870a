#include "common.h"
#include "layout.h"

// One work-item a triangle (thesis algorithm 3.1). Twin of server/shell/surface_voxelizer_cpu.cpp: the same
// float operations in the same order. Coordinates are in cells; all tests are written around cell centres, which turns
// eqs 3.2, 3.4 and 3.6-3.8 into |d| <= reach and d >= -reach.


// One projected edge (eq. 3.3): normal (na, nb), a point on it, and how far a cell centre may lie behind it.
typedef struct {
  float na, nb, va, vb, reach;
} Edge;

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

static Edge projected_edge(float ea, float eb, float va, float vb, float sign, float size, float flat_area, int thin) {
  Edge edge;
  edge.na = -eb * sign;
  edge.nb = ea * sign;
  edge.va = va;
  edge.vb = vb;
  const float a = magnitude(edge.na), b = magnitude(edge.nb);
  edge.reach = largest_reach(a, b, 0.0f, thin) + (size * (a + b) + flat_area) * REAM_VOXELIZER_EDGE_MARGIN;
  return edge;
}

kernel void voxelize_surface(global const float* corners, struct SurfaceVoxelizerArguments grid, global uint* words) {
  const uint triangle = get_global_id(0);
  if (triangle >= grid.triangles) return;
  const int dims[3] = {grid.dims_x, grid.dims_y, grid.dims_z};
  global const float* corner = corners + (size_t)triangle * REAM_VOXELIZER_FLOATS_PER_TRIANGLE;

  float v[3][3], e[3][3];
  int base[3], low[3], high[3];
  float extent = 0.0f;
  for (int k = 0; k < 3; ++k) {
    const float a = corner[k], b = corner[3 + k], c = corner[6 + k];
    const float least = a < b ? (a < c ? a : c) : (b < c ? b : c);
    const float most = a > b ? (a > c ? a : c) : (b > c ? b : c);
    base[k] = floor_to_int(least, -1.0f, (float)dims[k]);
    low[k] = (float)base[k] == least ? base[k] - 1 : base[k];
    high[k] = floor_to_int(most, -1.0f, (float)dims[k]);
    if (low[k] < 0) low[k] = 0;
    if (high[k] > dims[k] - 1) high[k] = dims[k] - 1;
    v[0][k] = a - (float)base[k];
    v[1][k] = b - (float)base[k];
    v[2][k] = c - (float)base[k];
    e[0][k] = v[1][k] - v[0][k];
    e[1][k] = v[2][k] - v[1][k];
    e[2][k] = v[0][k] - v[2][k];
    extent = larger(extent, most - least);
  }
  const float size = extent + 2.0f, flat_area = extent * extent;
  const float nx = e[0][1] * e[1][2] - e[0][2] * e[1][1];
  const float ny = e[0][2] * e[1][0] - e[0][0] * e[1][2];
  const float nz = e[0][0] * e[1][1] - e[0][1] * e[1][0];
  const float ax = magnitude(nx), ay = magnitude(ny), az = magnitude(nz);
  const float plane_reach = largest_reach(ax, ay, az, grid.thin) +
                            size * (((ax + ay) + az) * REAM_VOXELIZER_EDGE_MARGIN + flat_area * REAM_VOXELIZER_PLANE_MARGIN);

  Edge yz[3], xy[3], zx[3];
  for (int i = 0; i < 3; ++i) {
    xy[i] = projected_edge(e[i][0], e[i][1], v[i][0], v[i][1], nz >= 0.0f ? 1.0f : -1.0f, size, flat_area, grid.thin);
    yz[i] = projected_edge(e[i][1], e[i][2], v[i][1], v[i][2], nx >= 0.0f ? 1.0f : -1.0f, size, flat_area, grid.thin);
    zx[i] = projected_edge(e[i][2], e[i][0], v[i][2], v[i][0], ny >= 0.0f ? 1.0f : -1.0f, size, flat_area, grid.thin);
  }

  for (int w = low[2]; w <= high[2]; ++w) {
    const float z = (float)(w - base[2]) + 0.5f;
    for (int row = low[1]; row <= high[1]; ++row) {
      const float y = (float)(row - base[1]) + 0.5f;
      int outside = 0;
      float line_offset[6];
      for (int i = 0; i < 3; ++i) {
        outside |= !(yz[i].na * (y - yz[i].va) + (yz[i].nb * (z - yz[i].vb) + yz[i].reach) >= 0.0f);
        line_offset[i] = xy[i].nb * (y - xy[i].vb) + xy[i].reach;
        line_offset[3 + i] = zx[i].na * (z - zx[i].va) + zx[i].reach;
      }
      if (outside) continue;
      const float plane_offset = ny * (y - v[0][1]) + nz * (z - v[0][2]);
      global uint* row_words =
          words + (size_t)grid.words_per_row * ((size_t)row + (size_t)grid.dims_y * (size_t)w);
      uint bits = 0;
      for (int u = low[0]; u <= high[0]; ++u) {
        const float x = (float)(u - base[0]) + 0.5f;
        const float d = nx * (x - v[0][0]) + plane_offset;
        int inside = d <= plane_reach && -d <= plane_reach;
        for (int i = 0; i < 3; ++i) {
          inside &= xy[i].na * (x - xy[i].va) + line_offset[i] >= 0.0f;
          inside &= zx[i].nb * (x - zx[i].vb) + line_offset[3 + i] >= 0.0f;
        }
        bits |= (uint)inside << (u & 31);
        if ((u & 31) == 31 || u == high[0]) {
          if (bits != 0) atomic_or(&row_words[u >> 5], bits);
          bits = 0;
        }
      }
    }
  }
}
