#include "common.h"
#include "layout.h"
#pragma OPENCL EXTENSION cl_khr_fp64 : enable

// Twin of server/voxelizer/prepared_triangle.hpp, marked_rows.hpp and flip_triangle.cpp, where the method is
// explained: the same double operations in the same order, so the same bits. One work-item takes a triangle's part of
// a task: four rows of up to REAM_VOXELIZER_TASK_LAYERS layers.

#define MARGIN 9.5367431640625e-07
#define ROUNDER 6442450944.0
#define NO_BOUND 1e30
#define LEAST_SHARE 5.684341886080802e-14
#define SHORT_EDGE 32.0

typedef struct {
  double4 at[3];
  int low[3], high[3];
} PlacedTriangle;

typedef struct {
  double4 lower, upper, slope;
} EdgeBounds;

typedef struct {
  double at, by_v, by_w, width;
} PlaneBound;

static double smaller(double a, double b) { return a < b ? a : b; }
static double larger(double a, double b) { return a > b ? a : b; }
static double magnitude(double a) { return a < 0.0 ? -a : a; }
static double4 smaller4(double4 a, double4 b) { return a < b ? a : b; }
static double4 larger4(double4 a, double4 b) { return a > b ? a : b; }
static double4 magnitude4(double4 a) { return a < 0.0 ? -a : a; }
static double most_of_three(double4 a) { return larger(larger(a.x, a.y), a.z); }
static double least_of_three(double4 a) { return smaller(smaller(a.x, a.y), a.z); }

static int ceil_between(double x, int low, int high) {
  const double held = smaller(larger(x, (double)low), (double)high);
  const int whole = (int)held;
  return whole + ((double)whole < held);
}

static int floor_between(double x, int low, int high) {
  const double held = smaller(larger(x, (double)low), (double)high);
  const int whole = (int)held;
  return whole - ((double)whole > held);
}

static int4 ceil_between4(double4 x, double low, double high) {
  const double4 held = smaller4(larger4(x, (double4)low), (double4)high);
  const double4 whole = convert_double4(convert_int4(held));
  return convert_int4(whole < held ? whole + 1.0 : whole);
}

static int4 floor_between4(double4 x, double low, double high) {
  const double4 held = smaller4(larger4(x, (double4)low), (double4)high);
  const double4 whole = convert_double4(convert_int4(held));
  return convert_int4(whole > held ? whole - 1.0 : whole);
}

static double2 exact_product(double p, double q) {
  const double splitter = 134217729.0;
  const double sp = splitter * p, sq = splitter * q;
  const double ph = sp - (sp - p), qh = sq - (sq - q);
  const double pl = p - ph, ql = q - qh;
  const double value = p * q;
  return (double2)(value, ((ph * qh - value) + ph * ql + pl * qh) + pl * ql);
}

static double difference_of_products(double a, double b, double c, double d) {
  const double2 p = exact_product(a, b), q = exact_product(c, d);
  return (p.x - q.x) + (p.y - q.y);
}

static int place(PlacedTriangle* t, global const float* vertices, global const uint* triangle, constant double* map,
                 const struct VoxelizerArguments* grid) {
  global const float* a = vertices + 3 * (size_t)triangle[0];
  global const float* b = vertices + 3 * (size_t)triangle[1];
  global const float* c = vertices + 3 * (size_t)triangle[2];
  const int first[3] = {0, grid->v_begin, grid->w_begin}, end[3] = {grid->dims_x, grid->v_end, grid->w_end};
  for (int k = 2; k >= 0; --k) {
    const double4 file = (double4)((double)a[k], (double)b[k], (double)c[k], (double)a[k]);
    t->at[k] = ((file * map[k] + map[3 + k]) + ROUNDER) - ROUNDER;
    t->low[k] = ceil_between((least_of_three(t->at[k]) - 1.0) - MARGIN, first[k], end[k]);
    t->high[k] = floor_between(most_of_three(t->at[k]) + MARGIN, first[k] - 1, end[k] - 1);
    if (k > 0 && t->low[k] > t->high[k]) return 0;
  }
  return 1;
}

static void exact_normal(const PlacedTriangle* t, double* normal) {
  double a[3], b[3];
  double longest = 0.0;
  for (int k = 0; k < 3; ++k) {
    a[k] = t->at[k].y - t->at[k].x;
    b[k] = t->at[k].z - t->at[k].y;
    longest = larger(longest, larger(magnitude(a[k]), magnitude(b[k])));
  }
  for (int k = 0; k < 3; ++k) {
    const int i = k == 2 ? 0 : k + 1, j = k == 0 ? 2 : k - 1;
    normal[k] = longest < SHORT_EDGE ? a[i] * b[j] - a[j] * b[i] : difference_of_products(a[i], b[j], a[j], b[i]);
  }
}

static EdgeBounds edge_bounds(double4 x, double4 s, double side, int thin) {
  const double4 ex = x.yzxy - x, es = s.yzxy - s;
  const double4 nx = -es * side, ns = ex * side;
  const double4 mx = magnitude4(nx), ms = magnitude4(ns), sum = mx + ms;
  const double4 reach = 0.5 * (thin ? larger4(mx, ms) : sum) + MARGIN * sum;
  const double4 inverse = 1.0 / (mx > 0.0 ? nx : (double4)1.0);
  EdgeBounds bounds;
  bounds.slope = -ns * inverse;
  const double4 base = ((x - 0.5) - reach * inverse) - bounds.slope * (s - 0.5);
  bounds.lower = nx > 0.0 ? base : -(double4)NO_BOUND;
  bounds.upper = nx < 0.0 ? base : (double4)NO_BOUND;
  return bounds;
}

static double most_at(const EdgeBounds* b, double s) { return most_of_three(b->lower + b->slope * s); }
static double least_at(const EdgeBounds* b, double s) { return least_of_three(b->upper + b->slope * s); }

static PlaneBound plane_bound(const PlacedTriangle* t, const double* normal, int thin) {
  const double ax = magnitude(normal[0]), ay = magnitude(normal[1]), az = magnitude(normal[2]);
  const double sum = (ax + ay) + az;
  const double reach = 0.5 * (thin ? larger(larger(ax, ay), az) : sum) + MARGIN * sum;
  const int flat = sum > 0.0;
  const double across = larger(ax, LEAST_SHARE * sum);
  const double inverse = flat ? (normal[0] >= 0.0 ? 1.0 : -1.0) / across : 0.0;
  PlaneBound plane;
  plane.by_v = -normal[1] * inverse;
  plane.by_w = -normal[2] * inverse;
  plane.width = flat ? reach * magnitude(inverse) : NO_BOUND;
  plane.at = ((t->at[0].x - 0.5) - plane.by_v * (t->at[1].x - 0.5)) - plane.by_w * (t->at[2].x - 0.5);
  return plane;
}

static void set_word(global uint* word, uint bits) {
  if ((*(volatile global uint*)word & bits) != bits) atomic_or(word, bits);
}

static void set_bits(global uint* row, int low, int high) {
  const int first = low >> 5, last = high >> 5;
  const uint from = ~0u << (low & 31), to = ~0u >> (31 - (high & 31));
  if (first == last) {
    set_word(row + first, from & to);
    return;
  }
  set_word(row + first, from);
  for (int i = first + 1; i < last; ++i) set_word(row + i, ~0u);
  set_word(row + last, to);
}

static global uint* row_of(global uint* words, const struct VoxelizerArguments* grid, int v, int w) {
  return words + (size_t)grid->words_per_row *
                     ((size_t)(v - grid->v_begin) + (size_t)grid->rows_per_layer * (size_t)(w - grid->w_begin));
}

// Narrows a triangle's box to the part that a task names.
static int take_part(PlacedTriangle* t, uint part) {
  const int strips = (t->high[1] - t->low[1]) / REAM_VOXELIZER_TASK_ROWS + 1;
  t->low[1] += REAM_VOXELIZER_TASK_ROWS * ((int)part % strips);
  t->low[2] += REAM_VOXELIZER_TASK_LAYERS * ((int)part / strips);
  t->high[1] = min(t->high[1], t->low[1] + REAM_VOXELIZER_TASK_ROWS - 1);
  t->high[2] = min(t->high[2], t->low[2] + REAM_VOXELIZER_TASK_LAYERS - 1);
  return t->low[2] <= t->high[2];
}

kernel void mark_surface(global const float* vertices, global const uint* triangles, constant double* map,
                         global const uint2* tasks, struct VoxelizerArguments grid, global uint* words) {
  const size_t item = get_global_id(0);
  if (item >= grid.tasks) return;
  const uint2 task = tasks[item];
  PlacedTriangle t;
  if (!place(&t, vertices, triangles + 3 * (size_t)task.x, map, &grid) || t.low[0] > t.high[0]) return;
  double n[3];
  exact_normal(&t, n);
  const EdgeBounds u_by_v = edge_bounds(t.at[0], t.at[1], n[2] >= 0.0 ? 1.0 : -1.0, grid.thin);
  const EdgeBounds u_by_w = edge_bounds(t.at[0], t.at[2], n[1] <= 0.0 ? 1.0 : -1.0, grid.thin);
  const EdgeBounds v_by_w = edge_bounds(t.at[1], t.at[2], n[0] >= 0.0 ? 1.0 : -1.0, grid.thin);
  const PlaneBound plane = plane_bound(&t, n, grid.thin);
  if (!take_part(&t, task.y)) return;

  const int v = t.low[1];
  const double4 s = convert_double4((int4)(v, v + 1, v + 2, v + 3));
  const double4 strip_lower = larger4(larger4(u_by_v.lower.x + u_by_v.slope.x * s,
                                              u_by_v.lower.y + u_by_v.slope.y * s),
                                      u_by_v.lower.z + u_by_v.slope.z * s);
  const double4 strip_upper = smaller4(smaller4(u_by_v.upper.x + u_by_v.slope.x * s,
                                                u_by_v.upper.y + u_by_v.slope.y * s),
                                       u_by_v.upper.z + u_by_v.slope.z * s);
  const double4 strip_plane = plane.at + plane.by_v * s;
  const double low = (double)t.low[0], high = (double)t.high[0];
  for (int w = t.low[2]; w <= t.high[2]; ++w) {
    const double at_w = (double)w;
    const int begin = ceil_between(most_at(&v_by_w, at_w), v, t.high[1] + 1);
    const int end = floor_between(least_at(&v_by_w, at_w), v - 1, t.high[1]);
    if (begin > end) continue;
    const double4 middle = strip_plane + plane.by_w * at_w;
    const double4 least = larger4(larger4(strip_lower, (double4)most_at(&u_by_w, at_w)), middle - plane.width);
    const double4 most = smaller4(smaller4(strip_upper, (double4)least_at(&u_by_w, at_w)), middle + plane.width);
    int from[4], to[4];
    vstore4(ceil_between4(least, low, high + 1.0), 0, from);
    vstore4(floor_between4(most, low - 1.0, high), 0, to);
    global uint* row = row_of(words, &grid, begin, w);
    for (int i = begin - v; i <= end - v; ++i, row += grid.words_per_row)
      if (from[i] <= to[i]) set_bits(row, from[i], to[i]);
  }
}

kernel void flip_solid(global const float* vertices, global const uint* triangles, constant double* map,
                       global const uint2* tasks, struct VoxelizerArguments grid, global uint* words) {
  const size_t item = get_global_id(0);
  if (item >= grid.tasks) return;
  const uint2 task = tasks[item];
  PlacedTriangle t;
  if (!place(&t, vertices, triangles + 3 * (size_t)task.x, map, &grid)) return;
  double n[3];
  exact_normal(&t, n);
  const PlaneBound plane = plane_bound(&t, n, 0);
  if (!take_part(&t, task.y)) return;

  const double ys[3] = {t.at[1].x, t.at[1].y, t.at[1].z}, zs[3] = {t.at[2].x, t.at[2].y, t.at[2].z};
  double lower[3], upper[3], y_at[3], y_by_z[3];
  for (int i = 0; i < 3; ++i) {
    const int next = i == 2 ? 0 : i + 1;
    const int rises = zs[i] < zs[next];
    const int low = rises ? i : next, high = rises ? next : i;
    const double rise = zs[high] - zs[low];
    lower[i] = zs[low];
    upper[i] = zs[high];
    y_by_z[i] = (ys[high] - ys[low]) / (rise > 0.0 ? rise : 1.0);
    y_at[i] = ys[low] - y_by_z[i] * zs[low];
  }
  const double least = least_of_three(t.at[0]) - 0.5, most = most_of_three(t.at[0]) - 0.5;
  for (int w = t.low[2]; w <= t.high[2]; ++w) {
    const double z = (double)w + 0.5;
    double first = 1e30, last = -1e30;
    for (int i = 0; i < 3; ++i) {
      if (!(lower[i] <= z && z < upper[i])) continue;
      const double y = y_at[i] + y_by_z[i] * z;
      first = smaller(first, y);
      last = larger(last, y);
    }
    if (first > last) continue;
    const int begin = ceil_between(first - 0.5, t.low[1], t.high[1] + 1);
    const int end = ceil_between(last - 0.5, t.low[1], t.high[1] + 1);
    const double at_w = plane.at + plane.by_w * (double)w;
    for (int v = begin; v < end; ++v) {
      const double x = at_w + plane.by_v * (double)v;
      const int u = ceil_between(smaller(larger(x, least), most), 0, grid.dims_x);
      if (u < grid.dims_x) atomic_xor(row_of(words, &grid, v, w) + (u >> 5), 1u << (u & 31));
    }
  }
}

kernel void fill_rows(struct VoxelizerArguments grid, global uint* words) {
  const size_t item = get_global_id(0);
  if (item >= grid.tasks) return;
  global uint* row = words + (size_t)grid.words_per_row * item;
  uint before = 0;
  for (int i = 0; i < grid.words_per_row; ++i) {
    uint bits = row[i];
    for (int shift = 1; shift < 32; shift *= 2) bits ^= bits << shift;
    bits ^= before;
    before = 0u - (bits >> 31);
    row[i] = bits;
  }
  if ((grid.dims_x & 31) != 0) row[grid.words_per_row - 1] &= ~0u >> (32 - (grid.dims_x & 31));
}
