#include "score/vault_clearance.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/units.hpp"

namespace ream::score {
namespace {

constexpr double below_back_mm = 2.0, apart_mm = 1.0;
constexpr int corners_of_peg = 16;

int parts(double length_mm) { return std::max(1, static_cast<int>(std::ceil(length_mm / apart_mm))); }

void add_peg(const Peg& peg, std::vector<Vec3>& points) {
  const int levels = parts(peg.length_mm - below_back_mm);
  for (int level = 0; level <= levels; ++level) {
    const double z = below_back_mm + (peg.length_mm - below_back_mm) * level / levels;
    for (int corner = 0; corner < corners_of_peg; ++corner) {
      const double angle = 2.0 * pi * corner / corners_of_peg, radius = 0.5 * peg.diameter_mm;
      points.emplace_back(peg.anterior_mm + radius * std::cos(angle),
                          peg.superior_mm + radius * std::sin(angle), z);
    }
  }
  points.emplace_back(peg.anterior_mm, peg.superior_mm, peg.length_mm);
}

/// The outline of every level; its widest is at the back.
void add_keel(const Keel& keel, std::vector<Vec3>& points) {
  const int levels = parts(keel.length_mm - below_back_mm), rows = parts(keel.height_mm);
  for (int level = 0; level <= levels; ++level) {
    const double z = below_back_mm + (keel.length_mm - below_back_mm) * level / levels;
    const double t = z / keel.length_mm;
    const double half_height = 0.5 * (keel.height_mm + t * (keel.tip_height_mm - keel.height_mm));
    const double half_thickness = 0.5 * (keel.thickness_mm + t * (keel.tip_thickness_mm - keel.thickness_mm));
    for (int row = 0; row <= rows; ++row)
      for (const double side : {-1.0, 1.0})
        points.emplace_back(side * half_thickness, half_height * (2.0 * row / rows - 1.0), z);
  }
}

constexpr double max_distance_mm = 25.0;
constexpr int corners_of_nipple = 12;

/// Where the untouched bone is along the nearest ray; a peg beyond the exit has come through.
bool in_bone(const NativeGlenoid& native, const Vec3& in_lattice_mm) {
  const int ray = native.rays().nearest(in_lattice_mm.x(), in_lattice_mm.y());
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

std::span<const Fixation> fixations() {
  static const std::vector<Fixation> all{
      {"pegs", {{0.0, 0.0, 7.0, 15.0}, {0.0, 9.0, 4.5, 10.0}, {0.0, -9.0, 4.5, 10.0}}, {}},
      {"keel", {}, {Keel{}}}};
  return all;
}

const Fixation& fixation_named(std::string_view name) {
  for (const Fixation& fixation : fixations())
    if (fixation.name == name) return fixation;
  throw std::invalid_argument("no fixation " + std::string(name));
}

std::vector<Vec3> surface_points(const Fixation& fixation) {
  std::vector<Vec3> points;
  for (const Peg& peg : fixation.pegs) add_peg(peg, points);
  for (const Keel& keel : fixation.keels) add_keel(keel, points);
  return points;
}

void measure_vault_clearance(const NativeGlenoid& native, const Component& component, const CutLine& line,
                             MetricResults& results) {
  static const std::vector<Vec3> pegs = surface_points(fixation_named("pegs"));
  static const std::vector<Vec3> keel = surface_points(fixation_named("keel"));
  results.set("vault_distance_tool_mm", min_distance_mm(native, tip_of_tool(native, line)));
  const char* not_seated = "there is no bone left to seat a component on";
  for (const char* key : {"vault_distance_mm", "vault_distance_keel_mm", "vault_breach_mm"})
    results.set_missing(key, not_seated);
  if (!component.seated()) return;
  const Vec3 superior = superior_across(native, component.axis());
  const double of_pegs = min_distance_mm(native, placed(pegs, component, superior));
  results.set("vault_distance_mm", of_pegs);
  results.set("vault_breach_mm", std::max(0.0, -of_pegs));
  results.set("vault_distance_keel_mm", min_distance_mm(native, placed(keel, component, superior)));
}

}  // namespace ream::score
