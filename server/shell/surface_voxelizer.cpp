#include "shell/surface_voxelizer.hpp"

#include <bit>
#include <cmath>
#include <sstream>

#include "core/error.hpp"
#include "kernels/layout.h"

// All tests are written around cell centres, which turns eqs 3.2, 3.4 and 3.6-3.8 into |d| <= reach and d >=
// -reach.
namespace ream::shell {
namespace {

/// Cells along one side, and bytes of bits altogether, beyond which a request is a mistake rather than a
/// wish.
constexpr double max_volume_cells_per_side = 1 << 20;
constexpr double max_bytes = 16.0 * 1024 * 1024 * 1024;

constexpr float edge_margin = REAM_VOXELIZER_EDGE_MARGIN;
constexpr float plane_margin = REAM_VOXELIZER_PLANE_MARGIN;

float larger(float a, float b) { return a > b ? a : b; }
float magnitude(float a) { return a < 0.0f ? -a : a; }

/// floor(x), held within [low, high] so that the conversion is always defined.
int floor_to_int(float x, float low, float high) {
  if (!(x > low)) return static_cast<int>(low);
  if (!(x < high)) return static_cast<int>(high);
  const int whole = static_cast<int>(x);
  return static_cast<float>(whole) > x ? whole - 1 : whole;
}

/// How far a cell centre may lie from a plane or line with these normal components (magnitudes).
float max_reach(float a, float b, float c, bool thin) {
  return thin ? 0.5f * larger(larger(a, b), c) : 0.5f * ((a + b) + c);
}

/// One edge projected on a principal plane (eq. 3.3): normal (na, nb), a point on it, and how far a cell
/// centre may lie behind it.
struct Edge {
  float na = 0, nb = 0, va = 0, vb = 0, reach = 0;
};

/// A triangle prepared for its cells, in cells from `base`.
struct Prepared {
  int base[3], low[3], high[3];  ///< cells low..high are touched by the bounding box
  float v[3][3], e[3][3];        ///< corners and edges, [corner][axis]
  float n[3];                    ///< not normalised
  float extent = 0, plane_reach = 0;
  Edge xy[3], yz[3], zx[3];
};

void place(Prepared& t, const float* corner, const Vec3i& dims) {
  for (int k = 0; k < 3; ++k) {
    const float a = corner[k], b = corner[3 + k], c = corner[6 + k];
    const float least = a < b ? (a < c ? a : c) : (b < c ? b : c);
    const float most = a > b ? (a > c ? a : c) : (b > c ? b : c);
    t.base[k] = floor_to_int(least, -1.0f, static_cast<float>(dims[k]));
    t.low[k] = static_cast<float>(t.base[k]) == least ? t.base[k] - 1 : t.base[k];
    t.high[k] = floor_to_int(most, -1.0f, static_cast<float>(dims[k]));
    if (t.low[k] < 0) t.low[k] = 0;
    if (t.high[k] > dims[k] - 1) t.high[k] = dims[k] - 1;
    const float origin = static_cast<float>(t.base[k]);
    t.v[0][k] = a - origin;
    t.v[1][k] = b - origin;
    t.v[2][k] = c - origin;
    t.e[0][k] = t.v[1][k] - t.v[0][k];
    t.e[1][k] = t.v[2][k] - t.v[1][k];
    t.e[2][k] = t.v[0][k] - t.v[2][k];
    t.extent = larger(t.extent, most - least);
  }
}

void prepare_tests(Prepared& t, bool thin) {
  const float size = t.extent + 2.0f, flat_area = t.extent * t.extent;
  const auto& e = t.e;
  t.n[0] = e[0][1] * e[1][2] - e[0][2] * e[1][1];
  t.n[1] = e[0][2] * e[1][0] - e[0][0] * e[1][2];
  t.n[2] = e[0][0] * e[1][1] - e[0][1] * e[1][0];
  const float ax = magnitude(t.n[0]), ay = magnitude(t.n[1]), az = magnitude(t.n[2]);
  t.plane_reach =
      max_reach(ax, ay, az, thin) + size * (((ax + ay) + az) * edge_margin + flat_area * plane_margin);

  const auto projected = [&](int i, int a, int b, float facing) {
    const float sign = facing >= 0.0f ? 1.0f : -1.0f;
    Edge edge{-e[i][b] * sign, e[i][a] * sign, t.v[i][a], t.v[i][b], 0.0f};
    const float na = magnitude(edge.na), nb = magnitude(edge.nb);
    edge.reach = max_reach(na, nb, 0.0f, thin) + (size * (na + nb) + flat_area) * edge_margin;
    return edge;
  };
  for (int i = 0; i < 3; ++i) {
    t.xy[i] = projected(i, 0, 1, t.n[2]);
    t.yz[i] = projected(i, 1, 2, t.n[0]);
    t.zx[i] = projected(i, 2, 0, t.n[1]);
  }
}

void mark_row(const Prepared& t, float y, float z, uint32_t* words) {
  float line_offset[6];
  for (int i = 0; i < 3; ++i) {
    const Edge &yz = t.yz[i], &xy = t.xy[i], &zx = t.zx[i];
    if (!(yz.na * (y - yz.va) + (yz.nb * (z - yz.vb) + yz.reach) >= 0.0f)) return;
    line_offset[i] = xy.nb * (y - xy.vb) + xy.reach;
    line_offset[3 + i] = zx.na * (z - zx.va) + zx.reach;
  }
  const float plane_offset = t.n[1] * (y - t.v[0][1]) + t.n[2] * (z - t.v[0][2]);
  for (int u = t.low[0]; u <= t.high[0]; ++u) {
    const float x = static_cast<float>(u - t.base[0]) + 0.5f;
    const float d = t.n[0] * (x - t.v[0][0]) + plane_offset;
    if (!(d <= t.plane_reach && -d <= t.plane_reach)) continue;
    bool inside = true;
    for (int i = 0; i < 3; ++i) {
      inside &= t.xy[i].na * (x - t.xy[i].va) + line_offset[i] >= 0.0f;
      inside &= t.zx[i].nb * (x - t.zx[i].vb) + line_offset[3 + i] >= 0.0f;
    }
    words[u / 32] |= static_cast<uint32_t>(inside) << (u % 32);
  }
}

}  // namespace

size_t SurfaceVoxels::filled_cells() const {
  size_t count = 0;
  for (const uint32_t word : words) count += static_cast<size_t>(std::popcount(word));
  return count;
}

SurfaceVoxels surface_grid(const TriangleMesh& mesh, double size_mm) {
  if (!std::isfinite(size_mm) || size_mm <= 0.0) {
    std::ostringstream text;
    text << "the voxel size is " << size_mm << " mm; it must be positive";
    throw Error(ErrorKind::invalid_input, text.str());
  }
  if (mesh.triangles.empty()) throw Error(ErrorKind::invalid_input, "the mesh has no triangles to voxelize");
  const Aabb box = mesh.bounds();
  if (box.empty() || !box.min.allFinite() || !box.max.allFinite())
    throw Error(ErrorKind::invalid_input, "the mesh has vertices that are not finite");

  // Half a cell before, half a cell and rounding behind: the box's far side lies in the middle of the last
  // cell or before.
  constexpr double rounding_cells = 1e-6;
  const Vec3 cells = ((box.max - box.min) / size_mm).array() + (1.0 - rounding_cells);
  const double bytes = cells.x() / 8.0 * cells.y() * cells.z();
  if (!(cells.maxCoeff() < max_volume_cells_per_side) || !(bytes < max_bytes)) {
    std::ostringstream text;
    text << "voxels of " << size_mm << " mm would make a grid of " << std::ceil(cells.x()) << " x "
         << std::ceil(cells.y()) << " x " << std::ceil(cells.z()) << " cells; use larger voxels";
    throw Error(ErrorKind::invalid_input, text.str());
  }
  SurfaceVoxels grid;
  grid.size_mm = size_mm;
  grid.origin_mm = box.min.array() - 0.5 * size_mm;
  grid.dims = cells.array().ceil().max(1.0).cast<int>();
  grid.words.assign(grid.word_index(0, 0, grid.dims.z()), 0);
  return grid;
}

std::vector<float> surface_corners(const TriangleMesh& mesh, const SurfaceVoxels& grid) {
  std::vector<float> corners;
  corners.reserve(mesh.triangles.size() * 9);
  for (const auto& triangle : mesh.triangles)
    for (const uint32_t vertex : triangle) {
      const Vec3 cells = (mesh.vertices_mm[vertex].cast<double>() - grid.origin_mm) / grid.size_mm;
      for (int k = 0; k < 3; ++k) corners.push_back(static_cast<float>(cells[k]));
    }
  return corners;
}

void voxelize_surface_cpu(const TriangleMesh& mesh, Separability separability, SurfaceVoxels& grid) {
  const std::vector<float> corners = surface_corners(mesh, grid);
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    Prepared t;
    place(t, corners.data() + i * REAM_VOXELIZER_FLOATS_PER_TRIANGLE, grid.dims);
    prepare_tests(t, separability == Separability::six);
    for (int w = t.low[2]; w <= t.high[2]; ++w)
      for (int v = t.low[1]; v <= t.high[1]; ++v)
        mark_row(t, static_cast<float>(v - t.base[1]) + 0.5f, static_cast<float>(w - t.base[2]) + 0.5f,
                 grid.words.data() + grid.word_index(0, v, w));
  }
}

}  // namespace ream::shell
