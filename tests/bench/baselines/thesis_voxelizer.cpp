#include "bench/baselines/thesis_voxelizer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <thread>

#include "bench/baselines/kernel_source.hpp"
#include "bench/baselines/layout.h"

namespace ream::bench {
namespace {

using voxelizer::RasterGrid;

constexpr size_t local_size = 16;

struct Setup {
  struct Edge {
    float na, nb, d;
  };
  std::array<float, 3> n{};
  float d1 = 0.0f, d2 = 0.0f;
  std::array<std::array<Edge, 3>, 3> edges{};
  std::array<int, 3> low{}, high{};

  Setup(const float* corner, const Vec3i& dims) {
    float v[3][3];
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) v[i][k] = corner[3 * i + k];
    for (int k = 0; k < 3; ++k) {
      const auto at = static_cast<size_t>(k);
      low[at] =
          std::clamp(static_cast<int>(std::floor(std::min({v[0][k], v[1][k], v[2][k]}))), 0, dims[k] - 1);
      high[at] =
          std::clamp(static_cast<int>(std::floor(std::max({v[0][k], v[1][k], v[2][k]}))), 0, dims[k] - 1);
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      n[at] = (v[1][i] - v[0][i]) * (v[2][j] - v[1][j]) - (v[1][j] - v[0][j]) * (v[2][i] - v[1][i]);
    }
    for (int k = 0; k < 3; ++k) {
      const float normal = n[static_cast<size_t>(k)], c = normal > 0.0f ? 1.0f : 0.0f;
      d1 += normal * (c - v[0][k]);
      d2 += normal * (1.0f - c - v[0][k]);
    }
    for (int plane = 0; plane < 3; ++plane) {
      const int a = plane, b = (plane + 1) % 3;
      const float sign = n[static_cast<size_t>((plane + 2) % 3)] >= 0.0f ? 1.0f : -1.0f;
      for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        const float na = -(v[j][b] - v[i][b]) * sign, nb = (v[j][a] - v[i][a]) * sign;
        edges[static_cast<size_t>(plane)][static_cast<size_t>(i)] = {
            na, nb, -(na * v[i][a] + nb * v[i][b]) + std::max(0.0f, na) + std::max(0.0f, nb)};
      }
    }
  }

  bool overlap(size_t plane, float a, float b) const {
    for (const Edge& e : edges[plane])
      if (e.na * a + e.nb * b + e.d < 0.0f) return false;
    return true;
  }
};

size_t word_of(const RasterGrid& grid, int u, int v, int w) {
  return static_cast<size_t>(u / 32) +
         grid.words_per_row() *
             (static_cast<size_t>(v) + static_cast<size_t>(grid.dims.y()) * static_cast<size_t>(w));
}

/// Eqs 3.1-3.5 of one triangle and the voxel with its corner at p.
bool pair_overlaps(const float* corner, const float p[3]) {
  float e[3][3], n[3];
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) e[i][k] = corner[3 * ((i + 1) % 3) + k] - corner[3 * i + k];
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    n[k] = e[0][i] * e[1][j] - e[0][j] * e[1][i];
  }
  float a1 = 0.0f, a2 = 0.0f, np = 0.0f;
  for (int k = 0; k < 3; ++k) {
    const float c = n[k] > 0.0f ? 1.0f : 0.0f;
    a1 += n[k] * (c - corner[k]);
    a2 += n[k] * (1.0f - c - corner[k]);
    np += n[k] * p[k];
  }
  if ((np + a1) * (np + a2) > 0.0f) return false;
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3;
    const float side = n[(a + 2) % 3] >= 0.0f ? 1.0f : -1.0f;
    for (int i = 0; i < 3; ++i) {
      const float na = -e[i][b] * side, nb = e[i][a] * side;
      const float d =
          -(na * corner[3 * i + a] + nb * corner[3 * i + b]) + std::max(0.0f, na) + std::max(0.0f, nb);
      if (na * p[a] + nb * p[b] + d < 0.0f) return false;
    }
  }
  return true;
}

/// Bits of first to last along one axis, for every line of that axis, into `inside`: kept where they are set
/// there already.
struct LineFill {
  const std::vector<uint32_t>& surface;
  const RasterGrid& grid;
  std::vector<uint8_t>& hits;  ///< one a voxel: between first and last on so many axes

  size_t voxel(const Vec3i& p) const {
    return static_cast<size_t>(p.x()) +
           static_cast<size_t>(grid.dims.x()) *
               (static_cast<size_t>(p.y()) + static_cast<size_t>(grid.dims.y()) * static_cast<size_t>(p.z()));
  }
  bool is_surface(const Vec3i& p) const {
    return ((surface[word_of(grid, p.x(), p.y(), p.z())] >> (p.x() % 32)) & 1u) != 0;
  }
  void line(int axis, Vec3i p) const {
    int first = -1, last = -1;
    for (p[axis] = 0; p[axis] < grid.dims[axis]; ++p[axis])
      if (is_surface(p)) {
        if (first < 0) first = p[axis];
        last = p[axis];
      }
    if (first < 0) return;
    for (p[axis] = first; p[axis] <= last; ++p[axis]) ++hits[voxel(p)];
  }
  void lines(int axis, int part, int parts) const {
    // The outer loop runs along the slower of the two other axes.
    const int outer = axis == 2 ? 1 : 2, inner = axis == 0 ? 1 : 0;
    for (int i = grid.dims[outer] * part / parts; i < grid.dims[outer] * (part + 1) / parts; ++i)
      for (int j = 0; j < grid.dims[inner]; ++j) {
        Vec3i p = Vec3i::Zero();
        p[outer] = i;
        p[inner] = j;
        line(axis, p);
      }
  }
};

}  // namespace

std::vector<float> thesis_corners(const TriangleMesh& mesh, const RasterGrid& grid) {
  std::vector<float> corners;
  corners.reserve(9 * mesh.triangles.size());
  for (const auto& t : mesh.triangles)
    for (const uint32_t vertex : t)
      for (int k = 0; k < 3; ++k)
        corners.push_back(static_cast<float>(
            (static_cast<double>(mesh.vertices_mm[vertex][k]) - grid.origin_mm[k]) / grid.size_mm[k]));
  return corners;
}

ThesisVoxelizer::ThesisVoxelizer(const gpu::Queue& queue, const TriangleMesh& mesh, const RasterGrid& grid)
    : queue_(queue),
      grid_(grid),
      corners_(thesis_corners(mesh, grid)),
      words_(grid.rows() * grid.words_per_row(), 0),
      program_(
          gpu::Program::from_source(queue, "thesis_voxelizer.cl", baseline_source("thesis_voxelizer.cl"))),
      pair_(program_, "pair_voxelizer"),
      sat_(program_, "sat_voxelizer"),
      column_(program_, "column_voxelizer"),
      corner_buffer_(gpu::Buffer::over(queue, std::span(corners_))),
      word_buffer_(gpu::Buffer::over(queue, std::span(words_))) {}

void ThesisVoxelizer::run(gpu::Kernel& kernel) {
  const auto triangles = static_cast<uint32_t>(corners_.size() / 9);
  const layout::ThesisVoxelizerArguments arguments{triangles,
                                                   {grid_.dims.x(), grid_.dims.y(), grid_.dims.z()},
                                                   static_cast<int32_t>(grid_.words_per_row())};
  kernel.set_all(corner_buffer_, arguments, word_buffer_);
  kernel.enqueue(queue_, triangles, local_size);
  queue_.finish();
}

const std::vector<uint32_t>& ThesisVoxelizer::words() {
  if (!word_buffer_.shared()) word_buffer_.read(queue_, words_.data(), words_.size() * sizeof(uint32_t));
  return words_;
}

void thesis_voxelizer_serial(const std::vector<float>& corners, const RasterGrid& grid,
                             std::vector<uint32_t>& words) {
  for (size_t triangle = 0; triangle < corners.size() / 9; ++triangle) {
    const float* corner = corners.data() + 9 * triangle;
    std::array<int, 3> low{}, high{};
    for (int k = 0; k < 3; ++k) {
      const float least = std::min({corner[k], corner[3 + k], corner[6 + k]});
      const float most = std::max({corner[k], corner[3 + k], corner[6 + k]});
      const auto at = static_cast<size_t>(k);
      low[at] = std::clamp(static_cast<int>(std::floor(least)), 0, grid.dims[k] - 1);
      high[at] = std::clamp(static_cast<int>(std::floor(most)), 0, grid.dims[k] - 1);
    }
    for (int w = low[2]; w <= high[2]; ++w)
      for (int v = low[1]; v <= high[1]; ++v)
        for (int u = low[0]; u <= high[0]; ++u) {
          const float p[3] = {static_cast<float>(u), static_cast<float>(v), static_cast<float>(w)};
          if (pair_overlaps(corner, p)) words[word_of(grid, u, v, w)] |= 1u << (u % 32);
        }
  }
}

namespace {

void set_up_once(const std::vector<float>& all_corners, size_t first, size_t end, const RasterGrid& grid,
                 std::vector<uint32_t>& words) {
  for (size_t triangle = first; triangle < end; ++triangle) {
    const Setup s(all_corners.data() + 9 * triangle, grid.dims);
    for (int w = s.low[2]; w <= s.high[2]; ++w)
      for (int v = s.low[1]; v <= s.high[1]; ++v)
        for (int u = s.low[0]; u <= s.high[0]; ++u) {
          const auto x = static_cast<float>(u), y = static_cast<float>(v), z = static_cast<float>(w);
          const float np = s.n[0] * x + s.n[1] * y + s.n[2] * z;
          if ((np + s.d1) * (np + s.d2) > 0.0f) continue;
          if (!s.overlap(0, x, y) || !s.overlap(1, y, z) || !s.overlap(2, z, x)) continue;
          words[word_of(grid, u, v, w)] |= 1u << (u % 32);
        }
  }
}

}  // namespace

void set_up_once_serial(const std::vector<float>& corners, const RasterGrid& grid,
                        std::vector<uint32_t>& words) {
  set_up_once(corners, 0, corners.size() / 9, grid, words);
}

void set_up_once_threads(const std::vector<float>& corners, const RasterGrid& grid,
                         std::vector<uint32_t>& words) {
  const size_t triangles = corners.size() / 9;
  std::vector<uint32_t> other(words.size(), 0);
  std::thread second([&] { set_up_once(corners, triangles / 2, triangles, grid, other); });
  set_up_once(corners, 0, triangles / 2, grid, words);
  second.join();
  for (size_t i = 0; i < words.size(); ++i) words[i] |= other[i];
}

uint64_t triangle_based_tests(const std::vector<float>& corners, const RasterGrid& grid) {
  uint64_t tests = 0;
  for (size_t triangle = 0; triangle < corners.size() / 9; ++triangle) {
    const Setup s(corners.data() + 9 * triangle, grid.dims);
    uint64_t voxels = 1;
    for (size_t k = 0; k < 3; ++k) voxels *= static_cast<uint64_t>(s.high[k] - s.low[k] + 1);
    tests += voxels;
  }
  return tests;
}

std::vector<uint32_t> first_and_last_hit_fill(const std::vector<uint32_t>& surface, const RasterGrid& grid) {
  std::vector<uint8_t> hits(static_cast<size_t>(grid.voxels()), 0);
  const LineFill fill{surface, grid, hits};
  for (int axis = 0; axis < 3; ++axis) {
    const std::jthread helper([&] { fill.lines(axis, 1, 2); });
    fill.lines(axis, 0, 2);
  }
  std::vector<uint32_t> words(surface.size(), 0);
  for (int w = 0; w < grid.dims.z(); ++w)
    for (int v = 0; v < grid.dims.y(); ++v)
      for (int u = 0; u < grid.dims.x(); ++u)
        words[word_of(grid, u, v, w)] |= static_cast<uint32_t>(hits[fill.voxel({u, v, w})] == 3) << (u % 32);
  return words;
}

}  // namespace ream::bench
