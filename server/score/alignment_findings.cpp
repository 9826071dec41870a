#include "score/alignment_findings.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "case/plan_assessment.hpp"
#include "case/scapular_frame.hpp"
#include "core/error.hpp"
#include "core/units.hpp"

namespace ream::score {
namespace {

constexpr const char* no_plan = "the case has no plan";
constexpr const char* no_scapular_frame =
    "the case lacks one of the landmarks trigonum, inferior angle and glenoid centre";
constexpr const char* misses_surface = "the achieved axis does not meet the untouched surface near the face";
constexpr int steps_to_surface = 30;
constexpr double on_surface_mm = 1e-9;

double angle_deg(const Vec3& a, const Vec3& b) {
  return degrees_from_radians(std::atan2(a.cross(b).norm(), a.dot(b)));
}

std::optional<case_::ScapularFrame> scapular_frame_of(const Task& task) {
  const auto& l = task.anatomy.landmarks;
  if (!l || !l->glenoid_centre_mm || !l->trigonum_mm || !l->inferior_angle_mm) return std::nullopt;
  try {
    return case_::scapular_frame(*l->glenoid_centre_mm, *l->trigonum_mm, *l->inferior_angle_mm);
  } catch (const Error&) {
    return std::nullopt;
  }
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

void say_angles(const Task& task, const Vec3& world_axis, Findings& f) {
  const auto frame = scapular_frame_of(task);
  if (!frame) {
    for (const char* key : {"version_achieved_deg", "inclination_achieved_deg", "retroversion_achieved_deg",
                            "version_error_deg", "inclination_error_deg"})
      f.leave(key, no_scapular_frame);
    return;
  }
  const Angles achieved = angles_across(*frame, world_axis);
  f.say("version_achieved_deg", achieved.version_deg);
  f.say("inclination_achieved_deg", achieved.inclination_deg);
  f.say("retroversion_achieved_deg", -achieved.version_deg);
  if (!task.plan) return;
  const Angles planned = angles_across(*frame, task.plan->axis_direction);
  f.say("version_error_deg", std::abs(achieved.version_deg - planned.version_deg));
  f.say("inclination_error_deg", std::abs(achieved.inclination_deg - planned.inclination_deg));
}

void say_places(const NativeGlenoid& native, const CutLine& line, Findings& f) {
  const auto achieved = entry_of(native, line.apex_mm, line.direction);
  const auto planned = entry_of(native, Vec3::Zero(), Vec3::UnitZ());
  std::optional<double> distance;
  if (achieved) distance = (*achieved - planned.value_or(Vec3::Zero())).norm();
  f.say_or_leave("entry_error_mm", distance, misses_surface);
  const double angle = angle_deg(line.direction, Vec3::UnitZ());
  f.say("axis_error_deg", angle);
  if (native.task().plan->pilot_hole) {
    f.say_or_leave("pilot_entry_distance_mm", distance, misses_surface);
    f.say("pilot_angle_deg", angle);
  } else {
    for (const char* key : {"pilot_entry_distance_mm", "pilot_angle_deg"})
      f.leave(key, "the plan has no pilot hole");
  }
  const auto contact = first_contact_mm(native);
  std::optional<double> centre;
  if (contact)
    centre = (line.deepest_apex_mm() - Vec3(0.0, 0.0, *contact + native.task().plan->depth_mm)).norm();
  f.say_or_leave("centre_error_mm", centre, "the planned reamer does not touch the face");
}

}  // namespace

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

void say_plan(const Task& task, Findings& f) {
  const auto frame = scapular_frame_of(task);
  const char* reason = !task.plan ? no_plan : no_scapular_frame;
  for (const char* key : {"version_planned_deg", "inclination_planned_deg"}) f.leave(key, reason);
  f.leave("plan_correction_deg", !task.plan ? no_plan : "the case lacks rim landmarks and a glenoid frame");
  if (!task.plan) return;
  if (frame) {
    const Angles planned = angles_across(*frame, task.plan->axis_direction);
    f.say("version_planned_deg", planned.version_deg);
    f.say("inclination_planned_deg", planned.inclination_deg);
  }
  try {
    const case_::GlenoidFrame* glenoid = task.anatomy.glenoid ? &*task.anatomy.glenoid : nullptr;
    const case_::Landmarks landmarks = task.anatomy.landmarks.value_or(case_::Landmarks{});
    if (const auto native = case_::native_face(landmarks, task.anatomy.side, glenoid))
      f.say("plan_correction_deg", angle_deg(*native, -task.plan->axis_direction));
  } catch (const Error& e) {
    f.leave("plan_correction_deg", e.what());
  }
}

void say_alignment(const NativeGlenoid& native, const CutLine& line, double reaming_depth_mm, Findings& f) {
  const Task& task = native.task();
  leave_alignment(no_plan, f);
  say_angles(task, native.rays().world_direction(line.direction), f);
  if (!task.plan) return;
  say_places(native, line, f);
  f.say("depth_error_mm", std::abs(reaming_depth_mm - task.plan->depth_mm));
}

void say_rim(const Task& task, const std::optional<Vec3>& normal, Findings& f) {
  const auto frame = scapular_frame_of(task);
  const char* reason = !frame ? no_scapular_frame : "what was reamed has no rim";
  for (const char* key : {"version_rim_deg", "inclination_rim_deg"}) f.leave(key, reason);
  if (!frame || !normal) return;
  const Angles rim = angles_across(*frame, -*normal);
  f.say("version_rim_deg", rim.version_deg);
  f.say("inclination_rim_deg", rim.inclination_deg);
}

void leave_alignment(const std::string& reason, Findings& f) {
  for (const char* key :
       {"version_achieved_deg", "version_error_deg", "retroversion_achieved_deg", "inclination_achieved_deg",
        "inclination_error_deg", "axis_error_deg", "entry_error_mm", "centre_error_mm", "depth_error_mm",
        "pilot_entry_distance_mm", "pilot_angle_deg"})
    f.leave(key, reason);
}

}  // namespace ream::score
