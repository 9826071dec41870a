#include "shell/tool.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/text.hpp"
#include "core/units.hpp"
#include "geometry/mesh_io.hpp"
#include "shell/meridian.hpp"
#include "shell/mesh_tool.hpp"
#include "shell/parametric_profile.hpp"
#include "shell/reamer_library.hpp"

namespace ream::shell {
namespace {

constexpr double picture_tolerance_mm = 0.01;
constexpr int picture_segments = 96;

bool names_a_mesh(const std::string& description) {
  const std::filesystem::path path(description);
  const std::string extension = lower(path.extension().string());
  for (const char* known : {".stl", ".obj", ".ply", ".off", ".glb", ".gltf"})
    if (extension == known) return true;
  std::error_code ignored;
  return std::filesystem::is_regular_file(path, ignored);
}

ToolAxis checked(const ToolAxis& axis) {
  if (!axis.point_mm.allFinite() || !axis.direction.allFinite() || !(axis.direction.norm() > 0.0))
    throw Error(ErrorKind::usage, "tool axis: the point must be finite and the direction other than zero");
  return {axis.point_mm, axis.direction.normalized()};
}

Tool mesh_tool(const std::string& path, const std::optional<ToolAxis>& given_axis) {
  const TriangleMesh mesh = load_mesh(path);
  const ToolAxis axis = given_axis ? checked(*given_axis) : estimate_axis(mesh, path);
  Pose mesh_from_tool{rotation_with_z_along(axis.direction), axis.point_mm};
  const MeasuredProfile measured = tool_profile_from_mesh(mesh.transformed(mesh_from_tool.inverse()), path);
  mesh_from_tool.translation_mm += measured.apex_z_mm * axis.direction;
  const Pose tool_from_mesh = mesh_from_tool.inverse();
  return {path, mesh.transformed(tool_from_mesh), measured.profile, tool_from_mesh};
}

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

double ToolProfile::max_radius_mm() const {
  double radius = 0.0;
  for (const ProfilePoint& p : points) radius = std::max(radius, p.radius_mm);
  return radius;
}

double ToolProfile::min_z_mm() const {
  return std::min_element(points.begin(), points.end(), [](auto& a, auto& b) { return a.z_mm < b.z_mm; })
      ->z_mm;
}

double ToolProfile::max_z_mm() const {
  return std::max_element(points.begin(), points.end(), [](auto& a, auto& b) { return a.z_mm < b.z_mm; })
      ->z_mm;
}

Tool make_tool(const std::string& description, const std::optional<ToolAxis>& axis) {
  if (is_parametric(description)) {
    const ToolProfile profile = parametric_profile(description);
    return {description, revolve(simplified(profile, picture_tolerance_mm), picture_segments), profile,
            Pose{}};
  }
  if (!names_a_mesh(description))
    throw Error(ErrorKind::usage, "tool \"" + description + "\" is not known; " + tool_forms +
                                      "; reamers: " + built_in_names());
  return mesh_tool(description, axis);
}

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
