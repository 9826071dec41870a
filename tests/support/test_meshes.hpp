#pragma once
#include <random>

#include "geometry/triangle_mesh.hpp"

namespace ream::test {

/// Closed box from -half to half (mm), counter-clockwise from outside.
inline TriangleMesh box_mesh(const Vec3f& half) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices_mm.push_back({(i & 1 ? half : Vec3f(-half)).x(), (i & 2 ? half : Vec3f(-half)).y(),
                                (i & 4 ? half : Vec3f(-half)).z()});
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

/// Separate random triangles with corners in a cube of that edge, every eighth one a sliver.
inline TriangleMesh random_triangles(std::mt19937& random, int count, float edge_mm) {
  std::uniform_real_distribution<float> place(0.0f, edge_mm), scale(0.0f, 1.0f);
  TriangleMesh mesh;
  for (int i = 0; i < count; ++i) {
    const Vec3f centre(place(random), place(random), place(random));
    const float reach = scale(random) * scale(random);
    for (int corner = 0; corner < 3; ++corner) {
      const Vec3f other(place(random), place(random), place(random));
      mesh.vertices_mm.push_back(centre + reach * (other - centre));
    }
    const auto first = static_cast<uint32_t>(mesh.vertices_mm.size() - 3);
    if (i % 8 == 7)
      mesh.vertices_mm[first + 2] =
          mesh.vertices_mm[first] + scale(random) * (mesh.vertices_mm[first + 1] - mesh.vertices_mm[first]);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

/// One triangle of a mesh as a mesh of its own.
inline TriangleMesh only_triangle(const TriangleMesh& mesh, size_t triangle) {
  TriangleMesh one;
  for (const uint32_t vertex : mesh.triangles[triangle]) one.vertices_mm.push_back(mesh.vertices_mm[vertex]);
  one.triangles = {{0, 1, 2}};
  return one;
}

}  // namespace ream::test
