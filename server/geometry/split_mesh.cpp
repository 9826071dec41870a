#include "geometry/split_mesh.hpp"

#include <cassert>
#include <map>
#include <utility>

namespace ream {
namespace {

/// Takes corners of a mesh, or points on its edges, into a mesh of its own.
class Part {
 public:
  Part(const TriangleMesh& mesh, std::span<const float> values, float level)
      : mesh_(mesh), values_(values), level_(level), place_(mesh.vertices_mm.size(), unused) {}

  uint32_t corner(uint32_t vertex) {
    uint32_t& place = place_[vertex];
    if (place == unused)
      place = add(mesh_.vertices_mm[vertex], mesh_.normals.empty() ? Vec3f() : mesh_.normals[vertex]);
    return place;
  }

  /// Where the line crosses the edge a-b; from a's lower number on, so that neighbours agree.
  uint32_t crossing(uint32_t a, uint32_t b) {
    if (a > b) std::swap(a, b);
    const auto [found, is_new] = place_of_edge_.try_emplace({a, b}, 0);
    if (is_new) {
      const float t = (level_ - values_[a]) / (values_[b] - values_[a]);
      const auto between = [t](const Vec3f& from, const Vec3f& to) -> Vec3f {
        return from + t * (to - from);
      };
      found->second =
          add(between(mesh_.vertices_mm[a], mesh_.vertices_mm[b]),
              mesh_.normals.empty() ? Vec3f() : between(mesh_.normals[a], mesh_.normals[b]).normalized());
    }
    return found->second;
  }

  void triangle(uint32_t a, uint32_t b, uint32_t c) { part_.triangles.push_back({a, b, c}); }
  TriangleMesh take() { return std::move(part_); }

 private:
  static constexpr uint32_t unused = UINT32_MAX;

  uint32_t add(const Vec3f& vertex_mm, const Vec3f& normal) {
    part_.vertices_mm.push_back(vertex_mm);
    if (!mesh_.normals.empty()) part_.normals.push_back(normal);
    return static_cast<uint32_t>(part_.vertices_mm.size() - 1);
  }

  const TriangleMesh& mesh_;
  std::span<const float> values_;
  float level_;
  std::vector<uint32_t> place_;
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> place_of_edge_;
  TriangleMesh part_;
};

}  // namespace

SplitMesh split_at(const TriangleMesh& mesh, std::span<const float> values, float level) {
  assert(values.size() == mesh.vertices_mm.size());
  Part below(mesh, values, level), above(mesh, values, level);
  const auto is_above = [&](uint32_t vertex) { return values[vertex] >= level; };
  for (const auto& t : mesh.triangles) {
    const int count = is_above(t[0]) + is_above(t[1]) + is_above(t[2]);
    if (count == 0 || count == 3) {
      Part& part = count == 0 ? below : above;
      part.triangle(part.corner(t[0]), part.corner(t[1]), part.corner(t[2]));
      continue;
    }
    // One corner lies alone on its side: a triangle there, a quadrilateral on the other.
    const bool alone_above = count == 1;
    size_t alone = 0;
    while (is_above(t[alone]) != alone_above) ++alone;
    const uint32_t a = t[alone], b = t[(alone + 1) % 3], c = t[(alone + 2) % 3];
    Part &tip = alone_above ? above : below, &rest = alone_above ? below : above;
    tip.triangle(tip.corner(a), tip.crossing(a, b), tip.crossing(a, c));
    rest.triangle(rest.crossing(a, b), rest.corner(b), rest.corner(c));
    rest.triangle(rest.crossing(a, b), rest.corner(c), rest.crossing(a, c));
  }
  return {below.take(), above.take()};
}

}  // namespace ream
