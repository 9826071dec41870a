#include "score/vault_clearance.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/units.hpp"
#include "score/component_library.hpp"

namespace ream::score {
namespace {

constexpr double max_distance_mm = 25.0;
constexpr int corners_of_nipple = 12;

/// Where the untouched bone is along the rays around a place; a peg beyond the exit has come through.
bool in_bone(const NativeGlenoid& native, const Vec3& in_lattice_mm) {
  const RayLattice& rays = native.rays();
  const double between = rays.between(native.exit_mm(), in_lattice_mm.x(), in_lattice_mm.y());
  if (between != no_surface_mm) return in_lattice_mm.z() <= between;
  const int ray = rays.nearest(in_lattice_mm.x(), in_lattice_mm.y());
  if (ray < 0) return false;
  const auto i = static_cast<size_t>(ray);
  return native.surface_mm()[i] != no_surface_mm && in_lattice_mm.z() <= native.exit_mm()[i];
}

/// Least signed distance of points (frame of the lattice) from the outer cortex; max_distance_mm when none is
/// near.
double min_distance_mm(const NativeGlenoid& native, const std::vector<Vec3>& points) {
  double least = max_distance_mm;
  for (const Vec3& p : points) {
    const bool inside = in_bone(native, p);
    const double reach = inside ? std::max(0.5, std::abs(least)) : max_distance_mm;
    const double distance = native.outer_cortex().distance_mm(native.rays().world(p), reach).value_or(reach);
    least = std::min(least, inside ? distance : -distance);
  }
  return least;
}

/// Superior across the component's axis: the glenoid frame's, else the world's up; frame of the lattice.
Vec3 superior_across(const NativeGlenoid& native, const Vec3& axis) {
  Vec3 superior = Vec3::UnitY();
  if (native.task().anatomy.glenoid)
    superior = native.rays().lattice_direction(native.task().anatomy.glenoid->superior);
  const Vec3 part = superior - superior.dot(axis) * axis;
  if (part.norm() > 1e-3) return part.normalized();
  return (Vec3::UnitX() - axis.x() * axis).normalized();
}

std::vector<Vec3> placed(const std::vector<Vec3>& points, const Component& component, const Vec3& superior) {
  const Vec3 axis = component.axis(), anterior = axis.cross(superior), apex = component.apex_mm();
  std::vector<Vec3> found;
  found.reserve(points.size());
  for (const Vec3& p : points) found.push_back(apex + p.x() * anterior + p.y() * superior + p.z() * axis);
  return found;
}

/// The apex, or the rim of the nipple's tip, at the deepest.
std::vector<Vec3> tip_of_tool(const NativeGlenoid& native, const CutLine& line) {
  const shell::ToolProfile& profile = native.task().reamer;
  const Vec3 apex = line.deepest_apex_mm();
  std::vector<Vec3> points{apex};
  const double proud_mm = profile.max_z_mm();
  if (!(proud_mm > 0.0)) return points;
  double radius_mm = 0.0;
  for (const shell::ProfilePoint& p : profile.points)
    if (p.z_mm >= proud_mm) radius_mm = std::max(radius_mm, p.radius_mm);
  const Vec3 superior = superior_across(native, line.direction), across = line.direction.cross(superior);
  for (int i = 0; i < corners_of_nipple; ++i) {
    const double angle = 2.0 * pi * i / corners_of_nipple;
    points.push_back(apex + proud_mm * line.direction +
                     radius_mm * (std::cos(angle) * across + std::sin(angle) * superior));
  }
  return points;
}

}  // namespace

void measure_vault_clearance(const NativeGlenoid& native, const Component& component, const CutLine& line,
                             MetricResults& results) {
  results.set("vault_distance_tool_mm", min_distance_mm(native, tip_of_tool(native, line)));
  const char* not_seated = "there is no bone left to seat a component on";
  for (const char* key : {"vault_distance_mm", "vault_distance_keel_mm", "vault_distance_component_mm",
                          "vault_breach_mm", "parts_through_vault"})
    results.set_missing(key, not_seated);
  if (!component.seated()) return;
  const Vec3 superior = superior_across(native, component.axis());
  const auto distance_of = [&](const LibraryComponent& of) {
    std::vector<Vec3> points;
    for (const std::vector<Vec3>& part : surface_points(of))
      points.insert(points.end(), part.begin(), part.end());
    return min_distance_mm(native, placed(points, component, superior));
  };
  const LibraryComponent& own = component_of(native.task().plan);
  const double of_pegs = distance_of(virtual_component());
  const double of_own = &own == &virtual_component() ? of_pegs : distance_of(own);
  results.set("vault_distance_mm", of_pegs);
  results.set("vault_distance_keel_mm", distance_of(virtual_keel()));
  results.set("vault_distance_component_mm", of_own);
  results.set("vault_breach_mm", std::max(0.0, -of_own));
  size_t through = 0;
  for (const std::vector<Vec3>& part : surface_points(own)) {
    const std::vector<Vec3> points = placed(part, component, superior);
    through += std::any_of(points.begin(), points.end(), [&](const Vec3& p) { return !in_bone(native, p); });
  }
  results.set("parts_through_vault", static_cast<double>(through));
}

}  // namespace ream::score
