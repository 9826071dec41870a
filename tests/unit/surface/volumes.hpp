#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include "geometry/triangle_mesh.hpp"
#include "voxel/voxel_grid.hpp"

namespace ream::surface {

inline voxel::VoxelGrid grid_of(const Vec3i& dims, const Vec3& spacing_mm = Vec3::Ones()) {
  voxel::VoxelGrid grid;
  grid.dims = dims;
  grid.spacing_mm = spacing_mm;
  return grid;
}

/// Coverage that falls from 255 to 0 over one voxel around the zero level of `inside_mm` (positive inside).
inline std::vector<uint8_t> coverage_of(const voxel::VoxelGrid& grid,
                                        const std::function<double(const Vec3&)>& inside_mm) {
  std::vector<uint8_t> coverage(grid.voxel_count());
  for (size_t i = 0; i < coverage.size(); ++i) {
    const double c =
        127.5 + 255.0 * inside_mm(grid.centre_mm(grid.coordinates(i))) / grid.spacing_mm.maxCoeff();
    coverage[i] = static_cast<uint8_t>(std::floor(std::min(255.0, std::max(0.0, c)) + 0.5));
  }
  return coverage;
}

inline std::vector<uint8_t> sphere(const voxel::VoxelGrid& grid, const Vec3& centre_mm, double radius_mm) {
  return coverage_of(grid, [=](const Vec3& p) { return radius_mm - (p - centre_mm).norm(); });
}

/// Every voxel at random: a share is empty, a share full, the rest anything.
inline std::vector<uint8_t> noise(const voxel::VoxelGrid& grid, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<uint8_t> coverage(grid.voxel_count());
  const uint64_t empty = random() % 80, full = random() % 80;
  for (uint8_t& c : coverage) {
    const uint64_t roll = random() % 100;
    c = static_cast<uint8_t>(roll < empty ? 0 : roll < empty + full ? 255 : random() % 256);
  }
  return coverage;
}

struct Topology {
  bool closed = true;              ///< each directed edge once, and its opposite once
  bool one_fan_per_vertex = true;  ///< triangles around each vertex form one ring; every vertex is used
  int64_t euler = 0;               ///< V - E + F
};

inline Topology topology(size_t vertex_count, const std::vector<std::array<uint32_t, 3>>& triangles) {
  Topology result;
  using DirectedEdge = std::pair<uint64_t, uint32_t>;  // from and to, and the triangle's third vertex
  std::vector<DirectedEdge> edges;
  std::vector<uint32_t> corners(vertex_count), some_neighbour(vertex_count);
  const auto key = [](uint32_t from, uint32_t to) { return uint64_t{from} << 32 | to; };
  for (const auto& t : triangles)
    for (size_t i = 0; i < 3; ++i) {
      edges.emplace_back(key(t[i], t[(i + 1) % 3]), t[(i + 2) % 3]);
      ++corners[t[i]];
      some_neighbour[t[i]] = t[(i + 1) % 3];
    }
  std::sort(edges.begin(), edges.end());
  const auto find = [&](uint32_t from, uint32_t to) {
    const auto place = std::lower_bound(edges.begin(), edges.end(), DirectedEdge{key(from, to), 0});
    return place != edges.end() && place->first == key(from, to) ? &*place : nullptr;
  };
  for (size_t i = 0; i < edges.size(); ++i) {
    const auto from = static_cast<uint32_t>(edges[i].first >> 32), to = static_cast<uint32_t>(edges[i].first);
    if (i > 0 && edges[i - 1].first == edges[i].first) result.closed = false;
    if (find(to, from) == nullptr) result.closed = false;
  }
  for (uint32_t v = 0; result.closed && v < vertex_count; ++v) {
    if (corners[v] == 0) {
      result.one_fan_per_vertex = false;
      continue;
    }
    uint32_t ring = 0, neighbour = some_neighbour[v];
    do {
      neighbour = find(v, neighbour)->second;
      ++ring;
    } while (neighbour != some_neighbour[v] && ring <= corners[v]);
    if (ring != corners[v]) result.one_fan_per_vertex = false;
  }
  result.euler = static_cast<int64_t>(vertex_count) - static_cast<int64_t>(edges.size() / 2) +
                 static_cast<int64_t>(triangles.size());
  return result;
}

inline double area_mm2(const TriangleMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices_mm[t[0]].cast<double>(), b = mesh.vertices_mm[t[1]].cast<double>(),
               c = mesh.vertices_mm[t[2]].cast<double>();
    sum += 0.5 * (b - a).cross(c - a).norm();
  }
  return sum;
}

}  // namespace ream::surface
