// The thesis' voxelization kernel (section 3.5, algorithm 3.1): one work-item a triangle. `pair_voxelizer` invokes the
// whole test of eqs 3.1-3.5 for every pair of triangle and voxel of its box, as the kernels do that the thesis' author
// published; `sat_voxelizer` does the same with what belongs to the triangle set up once; `column_voxelizer` bounds
// each column along the normal's main axis by the plane equation (Schwarz and Seidel 2010) and tests what is left.

typedef struct {
  float n[2], d;
} Edge;

typedef struct {
  float n[3], d1, d2;
  Edge edges[3][3];  // planes xy, yz, zx
  int low[3], high[3];
} Setup;

static void setup_edges(Setup* s, const float v[3][3], int plane, int a, int b, float facing) {
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const float sign = facing >= 0.0f ? 1.0f : -1.0f;
    const float na = -(v[j][b] - v[i][b]) * sign, nb = (v[j][a] - v[i][a]) * sign;
    s->edges[plane][i].n[0] = na;
    s->edges[plane][i].n[1] = nb;
    s->edges[plane][i].d = -(na * v[i][a] + nb * v[i][b]) + fmax(0.0f, na) + fmax(0.0f, nb);
  }
}

static void setup_triangle(Setup* s, global const float* corner, const int* dims) {
  float v[3][3];
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) v[i][k] = corner[3 * i + k];
  float e0[3], e1[3];
  for (int k = 0; k < 3; ++k) {
    e0[k] = v[1][k] - v[0][k];
    e1[k] = v[2][k] - v[1][k];
    const float least = fmin(v[0][k], fmin(v[1][k], v[2][k])), most = fmax(v[0][k], fmax(v[1][k], v[2][k]));
    s->low[k] = clamp((int)floor(least), 0, dims[k] - 1);
    s->high[k] = clamp((int)floor(most), 0, dims[k] - 1);
  }
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    s->n[k] = e0[i] * e1[j] - e0[j] * e1[i];
  }
  s->d1 = s->d2 = 0.0f;
  for (int k = 0; k < 3; ++k) {
    const float c = s->n[k] > 0.0f ? 1.0f : 0.0f;
    s->d1 += s->n[k] * (c - v[0][k]);
    s->d2 += s->n[k] * (1.0f - c - v[0][k]);
  }
  setup_edges(s, v, 0, 0, 1, s->n[2]);
  setup_edges(s, v, 1, 1, 2, s->n[0]);
  setup_edges(s, v, 2, 2, 0, s->n[1]);
}

static int edges_overlap(const Setup* s, int plane, float a, float b) {
  for (int i = 0; i < 3; ++i) {
    const Edge* e = &s->edges[plane][i];
    if (e->n[0] * a + e->n[1] * b + e->d < 0.0f) return 0;
  }
  return 1;
}

static void set_bit(global uint* words, const int* dims, int words_per_row, int u, int v, int w) {
  atomic_or(&words[(size_t)(u >> 5) + (size_t)words_per_row * ((size_t)v + (size_t)dims[1] * (size_t)w)], 1u << (u & 31));
}

static int pair_overlaps(const float v[3][3], const float* p) {
  float e[3][3], n[3];
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) e[i][k] = v[(i + 1) % 3][k] - v[i][k];
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    n[k] = e[0][i] * e[1][j] - e[0][j] * e[1][i];
  }
  float a1 = 0.0f, a2 = 0.0f, np = 0.0f;
  for (int k = 0; k < 3; ++k) {
    const float c = n[k] > 0.0f ? 1.0f : 0.0f;
    a1 += n[k] * (c - v[0][k]);
    a2 += n[k] * (1.0f - c - v[0][k]);
    np += n[k] * p[k];
  }
  if ((np + a1) * (np + a2) > 0.0f) return 0;
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3;
    const float side = n[(a + 2) % 3] >= 0.0f ? 1.0f : -1.0f;
    for (int i = 0; i < 3; ++i) {
      const float na = -e[i][b] * side, nb = e[i][a] * side;
      const float d = -(na * v[i][a] + nb * v[i][b]) + fmax(0.0f, na) + fmax(0.0f, nb);
      if (na * p[a] + nb * p[b] + d < 0.0f) return 0;
    }
  }
  return 1;
}

kernel void pair_voxelizer(global const float* corners, struct ThesisVoxelizerArguments grid, global uint* words) {
  const uint triangle = get_global_id(0);
  if (triangle >= grid.triangles) return;
  const int dims[3] = {grid.dims[0], grid.dims[1], grid.dims[2]};
  float vertices[3][3];
  int low[3], high[3];
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) vertices[i][k] = corners[(size_t)triangle * 9 + 3 * i + k];
  for (int k = 0; k < 3; ++k) {
    low[k] = clamp((int)floor(fmin(vertices[0][k], fmin(vertices[1][k], vertices[2][k]))), 0, dims[k] - 1);
    high[k] = clamp((int)floor(fmax(vertices[0][k], fmax(vertices[1][k], vertices[2][k]))), 0, dims[k] - 1);
  }
  for (int w = low[2]; w <= high[2]; ++w)
    for (int v = low[1]; v <= high[1]; ++v)
      for (int u = low[0]; u <= high[0]; ++u) {
        const float p[3] = {(float)u, (float)v, (float)w};
        if (pair_overlaps(vertices, p)) set_bit(words, dims, grid.words_per_row, u, v, w);
      }
}

kernel void sat_voxelizer(global const float* corners, struct ThesisVoxelizerArguments grid, global uint* words) {
  const uint triangle = get_global_id(0);
  if (triangle >= grid.triangles) return;
  const int dims[3] = {grid.dims[0], grid.dims[1], grid.dims[2]};
  Setup s;
  setup_triangle(&s, corners + (size_t)triangle * 9, dims);
  for (int w = s.low[2]; w <= s.high[2]; ++w)
    for (int v = s.low[1]; v <= s.high[1]; ++v)
      for (int u = s.low[0]; u <= s.high[0]; ++u) {
        const float x = (float)u, y = (float)v, z = (float)w;
        const float np = s.n[0] * x + s.n[1] * y + s.n[2] * z;
        if ((np + s.d1) * (np + s.d2) > 0.0f) continue;
        if (!edges_overlap(&s, 0, x, y) || !edges_overlap(&s, 1, y, z) || !edges_overlap(&s, 2, z, x)) continue;
        set_bit(words, dims, grid.words_per_row, u, v, w);
      }
}

kernel void column_voxelizer(global const float* corners, struct ThesisVoxelizerArguments grid, global uint* words) {
  const uint triangle = get_global_id(0);
  if (triangle >= grid.triangles) return;
  const int dims[3] = {grid.dims[0], grid.dims[1], grid.dims[2]};
  Setup s;
  setup_triangle(&s, corners + (size_t)triangle * 9, dims);
  const float ax = fabs(s.n[0]), ay = fabs(s.n[1]), az = fabs(s.n[2]);
  const int c = ax >= ay && ax >= az ? 0 : ay >= az ? 1 : 2;  // along the column
  const int a = (c + 1) % 3, b = (c + 2) % 3;
  const int face = a, first_side = b, other_side = c;  // planes (a,b), (b,c), (c,a) begin with these axes
  const float inverse = s.n[c] != 0.0f ? 1.0f / s.n[c] : 0.0f;
  int at[3];
  for (at[b] = s.low[b]; at[b] <= s.high[b]; ++at[b])
    for (at[a] = s.low[a]; at[a] <= s.high[a]; ++at[a]) {
      const float pa = (float)at[a], pb = (float)at[b];
      if (!edges_overlap(&s, face, pa, pb)) continue;
      int from = s.low[c], to = s.high[c];
      if (s.n[c] != 0.0f) {
        const float q = s.n[a] * pa + s.n[b] * pb;
        const float r1 = -(q + s.d1) * inverse, r2 = -(q + s.d2) * inverse;
        from = max(from, (int)ceil(fmin(r1, r2) - 1e-3f));
        to = min(to, (int)floor(fmax(r1, r2) + 1e-3f));
      }
      for (at[c] = from; at[c] <= to; ++at[c]) {
        const float pc = (float)at[c];
        if (!edges_overlap(&s, first_side, pb, pc) || !edges_overlap(&s, other_side, pc, pa)) continue;
        set_bit(words, dims, grid.words_per_row, at[0], at[1], at[2]);
      }
    }
}
