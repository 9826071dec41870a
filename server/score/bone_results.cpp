#include "score/bone_results.hpp"

#include <algorithm>
#include <cmath>

#include "core/units.hpp"
#include "score/alignment.hpp"
#include "score/depth_gauge.hpp"
#include "score/joint_line.hpp"
#include "score/sphere_fit.hpp"
#include "score/vault_clearance.hpp"
#include "score/wall_thickness.hpp"

namespace ream::score {
namespace {

constexpr int directions = 360;
/// Rim points farther than this from its plane lie on a ledge or a wall.
constexpr double rim_bound_mm = 0.25;
constexpr double inside_rim_mm = 1.0;
/// Around the component's middle, where the bone left under it is looked at.
constexpr double middle_mm = 6.0;
/// Where the untouched bone is thinner than this the vault ends anyway, and no hole is made.
constexpr double thick_bone_mm = 5.0;

bool is_reamed(const AchievedFace& face, size_t ray) {
  return face.removed_mm[ray] >= reamed_mm && face.surface_mm[ray] != no_surface_mm;
}

/// Whether a ray and all four beside it are reamed and still meet bone.
bool is_amid_reamed(const RayLattice& rays, const AchievedFace& face, size_t ray) {
  if (!is_reamed(face, ray)) return false;
  constexpr int ways[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
  for (const auto& way : ways) {
    const int beside = rays.neighbour(ray, way[0], way[1]);
    if (beside < 0 || !is_reamed(face, static_cast<size_t>(beside))) return false;
  }
  return true;
}

/// The achieved face a little inside the outermost place where reamed_mm is gone; empty when there is none.
/// At that place itself the wall that a reamer leaves around it may be as well top as bottom.
/// `reamed_depth_mm`: of every ray, nothing where no bone is left under it.
std::optional<Vec3> rim_point(const RayLattice& rays, const AchievedFace& face,
                              const std::vector<double>& reamed_depth_mm, const Vec3& middle, double angle) {
  const double step = 0.5 * rays.spacing_mm();
  const double dx = std::cos(angle), dy = std::sin(angle);
  std::optional<double> last;
  double before = 0.0, edge = 0.0;
  for (double r = 0.0; r <= 2.0 * rays.reach_mm(); r += step) {
    const double removed = rays.between(reamed_depth_mm, middle.x() + r * dx, middle.y() + r * dy);
    if (removed == no_surface_mm) break;
    if (removed >= reamed_mm) {
      last = r;
      edge = r;
    } else if (last && *last == r - step && before > removed) {
      edge = r - step * (reamed_mm - removed) / (before - removed);
    }
    before = removed;
  }
  if (!last) return std::nullopt;
  const double r = edge - inside_rim_mm;
  const double x = middle.x() + r * dx, y = middle.y() + r * dy;
  const int ray = rays.nearest(x, y);
  if (ray < 0 || !is_amid_reamed(rays, face, static_cast<size_t>(ray))) return std::nullopt;
  const double z = rays.between(face.surface_mm, x, y);
  return z != no_surface_mm ? std::optional(Vec3(x, y, z)) : std::nullopt;
}

/// Of what was reamed, so much must still have bone for its shape to be spoken of.
constexpr double min_share_left = 0.1;

bool has_face(const NativeGlenoid& native) {
  for (const uint8_t face : native.face())
    if (face) return true;
  return false;
}

/// World normal, lateral, of the plane that fits the rim of what was reamed; empty without a rim.
std::optional<Vec3> rim_normal(const NativeGlenoid& native, const AchievedFace& face) {
  const RayLattice& rays = native.rays();
  Vec3 middle = Vec3::Zero();
  int count = 0;
  for (size_t ray = 0; ray < rays.size(); ++ray) {
    if (!is_reamed(face, ray)) continue;
    middle += Vec3(rays.x_mm(ray), rays.y_mm(ray), 0.0);
    ++count;
  }
  if (count == 0) return std::nullopt;
  middle /= count;
  std::vector<double> reamed_depth_mm(rays.size(), 0.0);
  for (size_t ray = 0; ray < rays.size(); ++ray)
    if (face.surface_mm[ray] != no_surface_mm) reamed_depth_mm[ray] = face.removed_mm[ray];
  std::vector<Vec3> rim;
  for (int i = 0; i < directions; ++i)
    if (const auto point = rim_point(rays, face, reamed_depth_mm, middle, 2.0 * pi * i / directions))
      rim.push_back(*point);
  if (rim.size() < directions / 2) return std::nullopt;
  const auto medial = fit_depth_plane(rim, rim_bound_mm);
  return medial ? std::optional(rays.world_direction(-*medial)) : std::nullopt;
}

/// Greatest and mean depth, medialization, footprint.
void measure_depths(const NativeGlenoid& native, const AchievedFace& face, MetricResults& results) {
  double sum = 0.0;
  size_t count = 0;
  for (const double removed : face.removed_mm) {
    if (removed < reamed_mm) continue;
    ++count;
    sum += removed;
  }
  const GreatestDepth greatest = greatest_depth(native, face);
  set_depth(native.task(), greatest.removed_mm, results);
  results.set("footprint_area_mm2", static_cast<double>(count) * native.rays().cell_area_mm2());
  results.set("medialization_mm", greatest.past_subchondral_mm);
  results.set("depth_mean_mm", count > 0 ? sum / static_cast<double>(count) : 0.0);
}

/// Sphere of the reamed surface and how far it is from one.
void measure_congruity(const NativeGlenoid& native, const AchievedFace& face, MetricResults& results) {
  std::vector<Vec3> points;
  size_t reamed = 0;
  for (size_t ray = 0; ray < native.rays().size(); ++ray) {
    reamed += face.removed_mm[ray] >= reamed_mm;
    if (is_amid_reamed(native.rays(), face, ray))
      points.emplace_back(native.rays().x_mm(ray), native.rays().y_mm(ray), face.surface_mm[ray]);
  }
  // Slivers at the edge of what is gone would fit a sphere all too well.
  const bool enough = static_cast<double>(points.size()) >= min_share_left * static_cast<double>(reamed);
  const auto sphere = enough ? fit_sphere(points) : std::nullopt;
  const char* too_little = "what was reamed is too small or too flat to fit a sphere to";
  for (const char* key : {"congruity_mm", "fitted_radius_mm"}) results.set_missing(key, too_little);
  if (!sphere) return;
  results.set("congruity_mm", sphere->mean_deviation_mm);
  results.set("fitted_radius_mm", sphere->radius_mm);
}

/// Bone that is left under the component's middle, and holes in the face.
void measure_vault_left(const NativeGlenoid& native, const AchievedFace& face, const Component& component,
                        MetricResults& results) {
  const Vec3 middle = component.apex_mm();
  std::optional<double> least_mm;
  size_t pierced = 0;
  for (const size_t ray : component.footprint()) {
    const double exit = native.exit_mm()[ray], surface = face.surface_mm[ray];
    const bool thick = exit - native.surface_mm()[ray] >= thick_bone_mm;
    pierced += thick && surface == no_surface_mm;
    const double aside_mm =
        std::hypot(native.rays().x_mm(ray) - middle.x(), native.rays().y_mm(ray) - middle.y());
    if (aside_mm > middle_mm || exit == no_surface_mm) continue;
    const double left = surface == no_surface_mm ? 0.0 : exit - surface;
    least_mm = std::min(least_mm.value_or(left), left);
  }
  results.set_or_missing("vault_depth_mm", least_mm, "the component has no face under its middle");
  results.set("perforated_area_mm2", static_cast<double>(pierced) * native.rays().cell_area_mm2());
}

}  // namespace

void set_depth(const Task& task, double depth_mm, MetricResults& results) {
  results.set("reaming_depth_mm", depth_mm);
  if (task.plan) results.set("depth_error_mm", std::abs(depth_mm - task.plan->depth_mm));
}

MetricResults bone_results(const NativeGlenoid& native, const PlannedFace& planned, const CoverageView& left,
                           const std::optional<CutLine>& plan_line, const Pose& world_from_plan) {
  MetricResults results;
  measure_plan(native.task(), results);
  if (!has_face(native)) {
    const char* no_face = "the planned axis meets no face of bone";
    for (const Basis basis : {Basis::untouched_bone, Basis::reamed_bone, Basis::achieved_axis})
      results.set_missing(basis, no_face);
    return results;
  }
  results.set("plate_thickness_mm", native.plate().median_mm);
  measure_planned_face(planned, results);
  if (!plan_line) {
    const char* untouched = "no bone was removed";
    for (const Basis basis : {Basis::reamed_bone, Basis::achieved_axis})
      results.set_missing(basis, untouched);
    results.set("reaming_depth_mm", 0.0);
    return results;
  }
  const CutLine line = in_lattice(native.rays(), *plan_line, world_from_plan);
  const AchievedFace face = achieved_face(native, left);
  measure_alignment(native, line, results);
  measure_depths(native, face, results);
  measure_congruity(native, face, results);
  measure_rim(native.task(), rim_normal(native, face), results);
  const Component component(native, face, line);
  if (component.seated())
    results.set("seating_percent", 100.0 * component.supported_share());
  else
    results.set_missing("seating_percent", "there is no bone left to seat a component on");
  results.set_or_missing("plate_preserved_percent",
                         plate_preserved_percent(native, face.removed_mm, component.footprint()),
                         "the component has no native face under it");
  measure_against_plan(native, planned, face, component, results);
  measure_vault_left(native, face, component, results);
  measure_joint_line(native, planned, component, results);
  measure_vault_clearance(native, component, line, results);
  measure_wall_thickness(native, face, left, component, results);
  return results;
}

MetricResults missing_bone_results(const std::string& reason) {
  MetricResults results;
  for (const Basis basis : {Basis::plan, Basis::untouched_bone, Basis::reamed_bone, Basis::achieved_axis})
    results.set_missing(basis, reason);
  return results;
}

}  // namespace ream::score
