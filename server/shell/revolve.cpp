#include <cmath>

#include "core/units.hpp"
#include "shell/tool.hpp"

namespace ream::shell {
namespace {

/// Vertex of profile point i at side j; points on the axis have a single vertex.
struct Rings {
  std::vector<uint32_t> first;
  std::vector<bool> on_axis;
  uint32_t segments = 0;

  uint32_t vertex(size_t i, uint32_t j) const { return on_axis[i] ? first[i] : first[i] + j % segments; }
};

Rings add_vertices(const ToolProfile& profile, uint32_t segments, TriangleMesh& mesh) {
  Rings rings{{}, {}, segments};
  for (const ProfilePoint& p : profile.points) {
    rings.first.push_back(static_cast<uint32_t>(mesh.vertices_mm.size()));
    rings.on_axis.push_back(p.radius_mm <= 0.0);
    if (rings.on_axis.back()) {
      mesh.vertices_mm.emplace_back(0.0f, 0.0f, static_cast<float>(p.z_mm));
      continue;
    }
    for (uint32_t j = 0; j < segments; ++j) {
      const double angle = 2.0 * pi * j / segments;
      mesh.vertices_mm.push_back(
          Vec3(p.radius_mm * std::cos(angle), p.radius_mm * std::sin(angle), p.z_mm).cast<float>());
    }
  }
  return rings;
}

}  // namespace

TriangleMesh revolve(const ToolProfile& profile, int segments) {
  TriangleMesh mesh;
  const auto sides = static_cast<uint32_t>(segments);
  const Rings rings = add_vertices(profile, sides, mesh);
  for (size_t i = 0; i + 1 < profile.points.size(); ++i)
    for (uint32_t j = 0; j < sides; ++j) {
      const uint32_t a = rings.vertex(i, j), b = rings.vertex(i + 1, j), c = rings.vertex(i + 1, j + 1),
                     d = rings.vertex(i, j + 1);
      if (b != c) mesh.triangles.push_back({a, b, c});
      if (a != d) mesh.triangles.push_back({a, c, d});
    }
  return mesh;
}

}  // namespace ream::shell
