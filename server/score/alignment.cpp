#include "score/alignment.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "case/planning.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "shell/parametric_profile.hpp"

namespace ream::score {
namespace {

constexpr const char* no_plan = "the case has no plan";
constexpr const char* misses_surface = "the achieved axis does not meet the untouched surface near the face";
constexpr int steps_to_surface = 30;
constexpr double on_surface_mm = 1e-9;
/// Version within this of neutral is a good correction (PMC4857532).
constexpr double neutral_version_deg = 7.0;

double angle_deg(const Vec3& a, const Vec3& b) {
  return degrees_from_radians(std::atan2(a.cross(b).norm(), a.dot(b)));
}

/// Angles of a face across an axis that points into the bone, degrees.
struct Angles {
  double version_deg, inclination_deg;
};

Angles angles_across(const case_::ScapularFrame& frame, const Vec3& axis) {
  const case_::FaceAngles angles = frame.angles_of(-axis);
  return {degrees_from_radians(angles.version_rad), degrees_from_radians(angles.inclination_rad)};
}

/// Where a line of the lattice's frame meets the untouched surface.
std::optional<Vec3> entry_of(const NativeGlenoid& native, const Vec3& point, const Vec3& direction) {
  if (std::abs(direction.z()) < 0.1) return std::nullopt;
  double s = -point.z() / direction.z();
  for (int i = 0; i < steps_to_surface; ++i) {
    const Vec3 at = point + s * direction;
    const double surface = native.rays().between(native.surface_mm(), at.x(), at.y());
    if (surface == no_surface_mm) return std::nullopt;
    const double step = (surface - at.z()) / direction.z();
    s += step;
    if (std::abs(step) < on_surface_mm) break;
  }
  return point + s * direction;
}

void measure_angles(const Task& task, const Vec3& world_axis, MetricResults& results) {
  const auto frame = scapular_frame_of(task);
  if (!frame) {
    for (const char* key : {"version_achieved_deg", "inclination_achieved_deg", "retroversion_achieved_deg",
                            "version_error_deg", "inclination_error_deg", "version_excess_deg"})
      results.set_missing(key, no_scapular_frame);
    return;
  }
  const Angles achieved = angles_across(*frame, world_axis);
  results.set("version_achieved_deg", achieved.version_deg);
  results.set("inclination_achieved_deg", achieved.inclination_deg);
  results.set("retroversion_achieved_deg", -achieved.version_deg);
  if (!task.plan) return;
  const Angles planned = angles_across(*frame, task.plan->axis_direction);
  results.set("version_error_deg", std::abs(achieved.version_deg - planned.version_deg));
  results.set("inclination_error_deg", std::abs(achieved.inclination_deg - planned.inclination_deg));
  const double allowed_deg = std::max(neutral_version_deg, std::abs(planned.version_deg));
  results.set("version_excess_deg", std::max(0.0, std::abs(achieved.version_deg) - allowed_deg));
}

void measure_places(const NativeGlenoid& native, const CutLine& line, MetricResults& results) {
  const auto achieved = entry_of(native, line.apex_mm, line.direction);
  const auto planned = entry_of(native, Vec3::Zero(), Vec3::UnitZ());
  std::optional<double> distance;
  if (achieved) distance = (*achieved - planned.value_or(Vec3::Zero())).norm();
  results.set_or_missing("entry_error_mm", distance, misses_surface);
  const double angle = angle_deg(line.direction, Vec3::UnitZ());
  results.set("axis_error_deg", angle);
  if (native.task().plan->pilot_hole) {
    results.set_or_missing("pilot_entry_distance_mm", distance, misses_surface);
    results.set("pilot_angle_deg", angle);
  } else {
    for (const char* key : {"pilot_entry_distance_mm", "pilot_angle_deg"})
      results.set_missing(key, "the plan has no pilot hole");
  }
  const auto contact = first_contact_mm(native);
  std::optional<double> centre;
  if (contact)
    centre = (line.deepest_apex_mm() - Vec3(0.0, 0.0, *contact + native.task().plan->depth_mm)).norm();
  results.set_or_missing("centre_error_mm", centre, "the planned reamer does not touch the face");
}

}  // namespace

std::optional<case_::ScapularFrame> scapular_frame_of(const Task& task) {
  const auto& l = task.anatomy.landmarks;
  if (!l || !l->glenoid_centre_mm || !l->trigonum_mm || !l->inferior_angle_mm) return std::nullopt;
  try {
    return case_::scapular_frame(*l->glenoid_centre_mm, *l->trigonum_mm, *l->inferior_angle_mm);
  } catch (const Error&) {
    return std::nullopt;
  }
}

std::optional<double> first_contact_mm(const NativeGlenoid& native) {
  double first = no_surface_mm;
  for (size_t ray = 0; ray < native.rays().size(); ++ray) {
    if (!native.face()[ray]) continue;
    const double radius = std::hypot(native.rays().x_mm(ray), native.rays().y_mm(ray));
    if (radius > native.reamer().outer_mm()) continue;
    first = std::min(first, native.surface_mm()[ray] + native.reamer().behind_mm(radius));
  }
  return first == no_surface_mm ? std::nullopt : std::optional(first);
}

CutLine in_lattice(const RayLattice& rays, const CutLine& plan_line, const Pose& world_from_plan) {
  CutLine line;
  line.apex_mm = rays.in_lattice(world_from_plan.point(plan_line.apex_mm));
  line.direction = rays.lattice_direction(world_from_plan.direction(plan_line.direction));
  // The plan's z and the lattice's depth differ only where there is no plan.
  line.deepest_mm = rays.in_lattice(world_from_plan.point(plan_line.deepest_apex_mm())).z();
  return line;
}

void measure_plan(const Task& task, MetricResults& results) {
  const auto frame = scapular_frame_of(task);
  const char* reason = !task.plan ? no_plan : no_scapular_frame;
  results.set_missing(Basis::plan, reason);
  results.set_missing("plan_correction_deg",
                      !task.plan ? no_plan : "the case lacks rim landmarks and a glenoid frame");
  if (!task.plan) return;
  results.set("depth_planned_mm", task.plan->depth_mm);
  if (frame) {
    const Angles planned = angles_across(*frame, task.plan->axis_direction);
    results.set("version_planned_deg", planned.version_deg);
    results.set("inclination_planned_deg", planned.inclination_deg);
  }
  try {
    const case_::GlenoidFrame* glenoid = task.anatomy.glenoid ? &*task.anatomy.glenoid : nullptr;
    const case_::Landmarks landmarks = task.anatomy.landmarks.value_or(case_::Landmarks{});
    if (const auto native = case_::native_face(landmarks, task.anatomy.side, glenoid))
      results.set("plan_correction_deg", angle_deg(*native, -task.plan->axis_direction));
  } catch (const Error& e) {
    results.set_missing("plan_correction_deg", e.what());
  }
}

void measure_alignment(const NativeGlenoid& native, const CutLine& line, MetricResults& results) {
  const Task& task = native.task();
  results.set_missing(Basis::achieved_axis, no_plan);
  measure_angles(task, native.rays().world_direction(line.direction), results);
  if (task.plan) measure_places(native, line, results);
}

void measure_rim(const Task& task, const std::optional<Vec3>& normal, MetricResults& results) {
  const auto frame = scapular_frame_of(task);
  const char* reason = !frame ? no_scapular_frame : "what was reamed has no rim";
  for (const char* key : {"version_rim_deg", "inclination_rim_deg"}) results.set_missing(key, reason);
  if (!frame || !normal) return;
  const Angles rim = angles_across(*frame, -*normal);
  results.set("version_rim_deg", rim.version_deg);
  results.set("inclination_rim_deg", rim.inclination_deg);
}

Placements placements_of(const NativeGlenoid& native, const CoverageView& left,
                         const std::optional<CutLine>& plan_line, const Pose& world_from_plan) {
  const RayLattice& rays = native.rays();
  const auto in_world = [&](const Vec3& apex_mm, const Vec3& axis) {
    return Placement{rays.world(apex_mm), rays.world_direction(axis)};
  };
  Placements placements;
  const auto& plan = native.task().plan;
  if (const auto contact = first_contact_mm(native); contact && plan)
    placements.planned = in_world(Vec3(0.0, 0.0, *contact + plan->depth_mm), Vec3::UnitZ());
  if (!plan_line) return placements;
  const CutLine line = in_lattice(rays, *plan_line, world_from_plan);
  placements.achieved = in_world(line.deepest_apex_mm(), line.direction);
  const Component component(native, achieved_face(native, left), line);
  if (component.seated()) placements.implant = in_world(component.apex_mm(), component.axis());
  return placements;
}

SweptFront implant_back(const Task& task, double thickness_mm) {
  if (!task.plan || !task.plan->implant_radius_mm) return {task.reamer, thickness_mm};
  const double radius_mm = *task.plan->implant_radius_mm;
  const double outer_mm = std::min(radius_mm, CuttingMeridian(task.reamer).outer_mm());
  const std::string words =
      "sphere " + nlohmann::json(radius_mm).dump() + "," + nlohmann::json(outer_mm).dump();
  return {shell::parametric_profile(words), thickness_mm};
}

}  // namespace ream::score
