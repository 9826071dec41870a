#include "bench/validate/plate_measures.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "score/bone_results.hpp"
#include "shell/tool.hpp"

namespace ream::bench {
namespace {

constexpr double reamer_radius_mm = 22.0, reamer_outer_mm = 10.0, component_mm = 9.5, overrun_mm = 0.3;
constexpr const char* reamer = "sphere 22,10";
constexpr double lattice_mm = 0.1, looked_at_mm = 20.0, beside_wall_mm = 0.5;

/// Height of a cap of a sphere over its apex.
double sagitta_mm(double radius_mm, double aside_mm) {
  return radius_mm - std::sqrt(radius_mm * radius_mm - aside_mm * aside_mm);
}

/// Of one line along the face's normal, so far aside of its axis: thickness of the plate, and how much of it
/// a reaming to a depth takes.
struct TrueLine {
  double whole_mm, face_mm;

  TrueLine(const test::AnalyticGlenoid& glenoid, double aside_mm) {
    const double under_mm = glenoid.radius_mm + glenoid.plate_mm;
    face_mm = -sagitta_mm(glenoid.radius_mm, aside_mm);
    whole_mm = glenoid.plate_mm - sagitta_mm(under_mm, aside_mm) - face_mm;
  }
  double removed_mm(double depth_mm, double aside_mm) const {
    if (aside_mm > reamer_outer_mm) return 0.0;
    return std::max(0.0, depth_mm - sagitta_mm(reamer_radius_mm, aside_mm) - face_mm);
  }
};

struct Shares {
  double preserved_percent, left_percent;
};

Shares shares_after(const test::AnalyticGlenoid& glenoid, double depth_mm) {
  double area = 0.0, preserved = 0.0, whole = 0.0, left = 0.0;
  for (double aside_mm = 0.5 * lattice_mm; aside_mm < component_mm; aside_mm += lattice_mm) {
    const TrueLine line(glenoid, aside_mm);
    const double removed_mm = std::min(line.whole_mm, line.removed_mm(depth_mm, aside_mm));
    area += aside_mm;
    preserved += removed_mm <= 0.5 * line.whole_mm ? aside_mm : 0.0;
    whole += aside_mm * line.whole_mm;
    left += aside_mm * (line.whole_mm - removed_mm);
  }
  return {100.0 * preserved / area, 100.0 * left / whole};
}

case_::Plan plan_of(const test::AnalyticGlenoid& glenoid) {
  const test::AnalyticGlenoid::Frame face = glenoid.frame();
  case_::Plan plan;
  plan.entry_mm = glenoid.mirrored(face.centre);
  plan.axis_direction = glenoid.mirrored(-face.n);
  plan.depth_mm = reamed_depth_mm(glenoid);
  plan.reamer = reamer;
  plan.pilot_hole.reset();
  return plan;
}

/// Coverage that falls across the reamer's sphere within a voxel; where it ends, at its rim, a wall stands.
std::vector<uint8_t> reamed(const voxel::BoneModel& bone, const case_::Plan& plan, double depth_mm) {
  std::vector<uint8_t> left = bone.coverage;
  const Vec3 middle = plan.entry_mm + (depth_mm - reamer_radius_mm) * plan.axis_direction;
  for (size_t i = 0; i < left.size(); ++i) {
    if (left[i] == 0) continue;
    const Vec3 offset =
        bone.grid.world_from_grid.point(bone.grid.centre_mm(bone.grid.coordinates(i))) - middle;
    const double along_mm = offset.dot(plan.axis_direction);
    const double aside_mm = (offset - along_mm * plan.axis_direction).norm();
    if (along_mm < 0.0 && aside_mm < reamer_outer_mm) {
      left[i] = 0;
      continue;
    }
    const double beyond_mm = std::max(offset.norm() - reamer_radius_mm, aside_mm - reamer_outer_mm);
    const double level = 127.5 + 255.0 * beyond_mm / bone.grid.min_spacing_mm();
    left[i] = std::min(left[i], static_cast<uint8_t>(std::clamp(level, 0.0, 255.0)));
  }
  return left;
}

}  // namespace

double reamed_depth_mm(const test::AnalyticGlenoid& glenoid) {
  // A circle of half the footprint's area.
  const double aside_mm = component_mm / std::sqrt(2.0);
  const TrueLine line(glenoid, aside_mm);
  return 0.5 * line.whole_mm + line.face_mm + sagitta_mm(reamer_radius_mm, aside_mm) - overrun_mm;
}

PlateMeasures true_plate(const test::AnalyticGlenoid& glenoid) {
  const test::GlenoidFormulas formulas(glenoid);
  const test::AnalyticGlenoid::Frame face = glenoid.frame();
  std::vector<double> thickness;
  for (double up_mm = -looked_at_mm; up_mm <= looked_at_mm; up_mm += lattice_mm)
    for (double front_mm = -looked_at_mm; front_mm <= looked_at_mm; front_mm += lattice_mm) {
      const double aside_mm = std::hypot(up_mm, front_mm);
      if (aside_mm > looked_at_mm) continue;
      const TrueLine line(glenoid, aside_mm);
      const Vec3 at = face.centre + up_mm * face.superior + front_mm * face.anterior - line.face_mm * face.n;
      if (formulas.beyond_wall_mm(glenoid.mirrored(at)) < -beside_wall_mm) thickness.push_back(line.whole_mm);
    }
  std::nth_element(thickness.begin(), thickness.begin() + static_cast<std::ptrdiff_t>(thickness.size() / 2),
                   thickness.end());
  const double planned_mm = reamed_depth_mm(glenoid);
  const Shares planned = shares_after(glenoid, planned_mm),
               achieved = shares_after(glenoid, planned_mm + overrun_mm);
  return {thickness[thickness.size() / 2], achieved.preserved_percent, planned.preserved_percent,
          planned.left_percent - achieved.left_percent};
}

PlateMeasures measured_plate(const test::AnalyticGlenoid& glenoid, const voxel::BoneModel& bone) {
  score::Task task;
  task.anatomy.side = glenoid.shoulder.side;
  task.plan = plan_of(glenoid);
  task.reamer = shell::make_tool(reamer).profile;
  const score::NativeGlenoid native(task, bone);
  const double depth_mm = task.plan->depth_mm + overrun_mm;
  const std::vector<uint8_t> left = reamed(bone, *task.plan, depth_mm);
  score::CutLine line;
  line.apex_mm.z() = line.deepest_mm = depth_mm;
  const Pose world_from_plan{rotation_with_z_along(task.plan->axis_direction), task.plan->entry_mm};
  const score::MetricResults results = score::bone_results(native, score::planned_face(native),
                                                           {bone.grid, left.data()}, line, world_from_plan);
  const auto value = [&](const char* key) { return results.value(key).value_or(-1.0); };
  return {value("plate_thickness_mm"), value("plate_preserved_percent"), value("plate_planned_percent"),
          value("plate_lost_percent")};
}

}  // namespace ream::bench
