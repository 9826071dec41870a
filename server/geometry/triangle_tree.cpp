#include "geometry/triangle_tree.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace ream {
namespace {

constexpr uint32_t leaf_triangles = 4;

double segment_distance2(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double length2 = ab.squaredNorm();
  const double t = length2 > 0.0 ? std::clamp((p - a).dot(ab) / length2, 0.0, 1.0) : 0.0;
  return (p - a - t * ab).squaredNorm();
}

double triangle_distance2(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = (b - a).cross(c - a);
  const double area2 = normal.squaredNorm();
  if (area2 > 0.0) {
    const auto left_of = [&](const Vec3& from, const Vec3& to) {
      return normal.cross(to - from).dot(p - from) >= 0.0;
    };
    if (left_of(a, b) && left_of(b, c) && left_of(c, a)) {
      const double height = normal.dot(p - a);
      return height * height / area2;
    }
  }
  return std::min({segment_distance2(p, a, b), segment_distance2(p, b, c), segment_distance2(p, c, a)});
}

/// Squared distance from a point to a box; 0 inside.
double box_distance2(const Vec3& p, const Vec3f& min, const Vec3f& max) {
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double off =
        std::max({static_cast<double>(min[axis]) - p[axis], p[axis] - static_cast<double>(max[axis]), 0.0});
    sum += off * off;
  }
  return sum;
}

}  // namespace

double triangle_distance_mm(const Vec3& point, const Vec3& a, const Vec3& b, const Vec3& c) {
  return std::sqrt(triangle_distance2(point, a, b, c));
}

TriangleTree::TriangleTree(const TriangleMesh& mesh, const Aabb* within) {
  for (const auto& t : mesh.triangles) {
    const Triangle triangle{mesh.vertices_mm[t[0]], mesh.vertices_mm[t[1]], mesh.vertices_mm[t[2]]};
    if (within) {
      Aabb box;
      for (const Vec3f& corner : {triangle.a, triangle.b, triangle.c}) box.include(corner.cast<double>());
      if (box.intersection(*within).empty()) continue;
    }
    triangles_.push_back(triangle);
  }
  nodes_.reserve(triangles_.size());
  if (!triangles_.empty()) build(0, static_cast<uint32_t>(triangles_.size()));
}

uint32_t TriangleTree::build(uint32_t first, uint32_t last) {
  const auto index = static_cast<uint32_t>(nodes_.size());
  Node node;
  node.min = Vec3f::Constant(1e30f);
  node.max = Vec3f::Constant(-1e30f);
  for (uint32_t i = first; i < last; ++i)
    for (const Vec3f& corner : {triangles_[i].a, triangles_[i].b, triangles_[i].c}) {
      node.min = node.min.cwiseMin(corner);
      node.max = node.max.cwiseMax(corner);
    }
  nodes_.push_back(node);
  if (last - first <= leaf_triangles) {
    nodes_[index].first = first;
    nodes_[index].count = last - first;
    return index;
  }
  int axis = 0;
  (node.max - node.min).maxCoeff(&axis);
  const uint32_t middle = first + (last - first) / 2;
  std::nth_element(triangles_.begin() + first, triangles_.begin() + middle, triangles_.begin() + last,
                   [axis](const Triangle& a, const Triangle& b) {
                     return a.a[axis] + a.b[axis] + a.c[axis] < b.a[axis] + b.b[axis] + b.c[axis];
                   });
  build(first, middle);
  const uint32_t second = build(middle, last);
  nodes_[index].second = second;
  return index;
}

double TriangleTree::distance_mm(const Vec3& p, double limit_mm) const {
  if (nodes_.empty()) return limit_mm;
  double best2 = limit_mm * limit_mm;
  std::array<uint32_t, 64> open{};
  size_t depth = 0;
  open[depth++] = 0;
  while (depth > 0) {
    const uint32_t index = open[--depth];
    const Node& node = nodes_[index];
    if (box_distance2(p, node.min, node.max) >= best2) continue;
    for (uint32_t i = node.first; i < node.first + node.count; ++i)
      best2 =
          std::min(best2, triangle_distance2(p, triangles_[i].a.cast<double>(),
                                             triangles_[i].b.cast<double>(), triangles_[i].c.cast<double>()));
    if (node.count > 0) continue;
    const uint32_t children[2] = {index + 1, node.second};
    const bool swap = box_distance2(p, nodes_[children[0]].min, nodes_[children[0]].max) <
                      box_distance2(p, nodes_[children[1]].min, nodes_[children[1]].max);
    open[depth++] = children[swap ? 1 : 0];
    open[depth++] = children[swap ? 0 : 1];
  }
  return std::sqrt(best2);
}

}  // namespace ream
