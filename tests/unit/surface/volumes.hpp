#pragma once
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <span>
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

/// Directed edges by the vertex that they start from.
class Fans {
 public:
  struct Edge {
    uint32_t to, third;  ///< third vertex of the edge's triangle
  };

  Fans(size_t vertex_count, const std::vector<std::array<uint32_t, 3>>& triangles)
      : first_(vertex_count + 1), edges_(3 * triangles.size()) {
    for (const auto& t : triangles)
      for (const uint32_t v : t) ++first_[v + 1];
    for (size_t v = 0; v < vertex_count; ++v) first_[v + 1] += first_[v];
    std::vector<size_t> next(first_.begin(), first_.end() - 1);
    for (const auto& t : triangles)
      for (size_t i = 0; i < 3; ++i) edges_[next[t[i]]++] = {t[(i + 1) % 3], t[(i + 2) % 3]};
  }

  std::span<const Edge> of(uint32_t vertex) const {
    return {edges_.data() + first_[vertex], first_[vertex + 1] - first_[vertex]};
  }
  /// How often the edge is there, and the third vertex of its (last) triangle.
  size_t count(uint32_t from, uint32_t to, uint32_t& third) const {
    size_t found = 0;
    for (const Edge& e : of(from))
      if (e.to == to) ++found, third = e.third;
    return found;
  }

 private:
  std::vector<size_t> first_;
  std::vector<Edge> edges_;
};

inline Topology topology(size_t vertex_count, const std::vector<std::array<uint32_t, 3>>& triangles) {
  Topology result;
  const Fans fans(vertex_count, triangles);
  uint32_t third = 0;
  for (uint32_t v = 0; v < vertex_count; ++v)
    for (const Fans::Edge& e : fans.of(v))
      if (fans.count(v, e.to, third) != 1 || fans.count(e.to, v, third) != 1) result.closed = false;
  for (uint32_t v = 0; result.closed && v < vertex_count; ++v) {
    const auto fan = fans.of(v);
    size_t ring = 0;
    if (!fan.empty()) {
      uint32_t neighbour = fan[0].to;
      do {
        fans.count(v, neighbour, third);
        neighbour = third;
        ++ring;
      } while (neighbour != fan[0].to && ring <= fan.size());
    }
    if (ring == 0 || ring != fan.size()) result.one_fan_per_vertex = false;
  }
  result.euler = static_cast<int64_t>(vertex_count) - static_cast<int64_t>(triangles.size() * 3 / 2) +
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
