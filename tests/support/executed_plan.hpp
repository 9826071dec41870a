#pragma once
#include <nlohmann/json.hpp>

#include "core/clock.hpp"
#include "score/alignment.hpp"
#include "score/bone_results.hpp"
#include "score/metrics.hpp"
#include "support/random_reaming.hpp"

namespace ream::test {

/// How a session strays from its plan.
struct Stray {
  double version_deg = 0.0, inclination_deg = 0.0;  ///< of the axis
  double anterior_mm = 0.0, superior_mm = 0.0;      ///< of the entry
  double depth_mm = 0.0;                            ///< beyond the planned depth
  double thrust_n = 52.0;
  double overload_s = 0.0;  ///< of the cut, at 90 N
  double surface_c = 38.0;  ///< temperature of the bone
};

/// A plan on a bone given by formulas, and sessions that carry it out as told: the reamer comes down an axis
/// to a depth, what it sweeps is gone, and the ticks say so. No simulation: what scores read is all there.
class ExecutedPlan {
 public:
  ExecutedPlan(const PlannedReaming& planned, double voxel_mm)
      : planned_(planned),
        formulas_(planned.glenoid),
        bone_(bone_of(planned.glenoid, voxel_mm)),
        native_(task_of(planned), bone_),
        planned_face_(score::planned_face(native_)) {}

  /// metrics.json of such a session.
  nlohmann::json metrics(const Stray& stray) const {
    const Pose end = end_of(stray);
    const score::MetricsAccumulator ticks = ticks_to(end, stray);
    const std::vector<uint8_t> left = left_by(end);
    return score::session_metrics_json(
        ticks,
        score::bone_results(native_, planned_face_, {bone_.grid, left.data()}, ticks.cut_line(), plan_pose()),
        1.0, nullptr);
  }

  const score::NativeGlenoid& native() const { return native_; }
  const voxel::BoneModel& bone() const { return bone_; }

  /// What such a session leaves, and its axis in the frame of the lattice.
  struct Left {
    std::vector<uint8_t> coverage;
    score::CutLine line;
  };
  Left left(const Stray& stray) const {
    const Pose end = end_of(stray);
    return {left_by(end), score::in_lattice(native_.rays(), *ticks_to(end, stray).cut_line(), plan_pose())};
  }

  /// metrics.json of one that ended before anything was touched.
  nlohmann::json untouched() const {
    const score::MetricsAccumulator ticks(bone_.grid.voxel_volume_mm3(), plan_pose().inverse());
    return score::session_metrics_json(
        ticks,
        score::bone_results(native_, planned_face_, {bone_.grid, bone_.coverage.data()}, std::nullopt,
                            plan_pose()),
        1.0, nullptr);
  }

 private:
  static constexpr double advance_mm = 0.01;  ///< a tick

  static score::Task task_of(const PlannedReaming& planned) {
    score::Task task;
    task.anatomy.side = planned.glenoid.shoulder.side;
    task.anatomy.landmarks = shoulder_landmarks(planned.glenoid.shoulder);
    task.anatomy.glenoid = case_::glenoid_frame(*task.anatomy.landmarks, task.anatomy.side);
    task.plan = planned.plan;
    task.reamer = shell::make_tool(planned.reamer.words()).profile;
    return task;
  }

  Pose plan_pose() const {
    return {rotation_with_z_along(planned_.plan.axis_direction), planned_.plan.entry_mm};
  }

  /// The reamer's apex at its deepest, z into the bone.
  Pose end_of(const Stray& stray) const {
    const AnalyticGlenoid& glenoid = planned_.glenoid;
    const AnalyticGlenoid::Frame face = glenoid.frame();
    // In the frame of a right shoulder, where anterior and superior are what they are.
    const Vec3 planned = glenoid.mirrored(planned_.plan.axis_direction);
    const Vec3 axis = glenoid.mirrored(
        Eigen::AngleAxisd(radians_from_degrees(stray.inclination_deg), face.anterior) *
        (Eigen::AngleAxisd(radians_from_degrees(stray.version_deg), face.superior) * planned));
    const Vec3 entry = planned_.plan.entry_mm + glenoid.mirrored(stray.anterior_mm * face.anterior +
                                                                 stray.superior_mm * face.superior);
    const Mat3 turn = rotation_with_z_along(axis);
    return {turn, entry + (first_touch_mm(entry, turn) + planned_.plan.depth_mm + stray.depth_mm) * axis};
  }

  /// How far an apex goes along an axis from a place until the reamer touches the face.
  double first_touch_mm(const Vec3& entry, const Mat3& turn) const {
    constexpr double step_mm = 0.25;
    const double outer = planned_.reamer.outer_mm, radius = planned_.glenoid.radius_mm;
    double first = 1e9;
    for (double x = -outer; x <= outer; x += step_mm)
      for (double y = -outer; y <= outer; y += step_mm) {
        if (std::hypot(x, y) > outer) continue;
        const Vec3 from = entry + x * turn.col(0) + y * turn.col(1),
                   offset = from - formulas_.sphere_centre();
        const double b = offset.dot(turn.col(2)), c = offset.squaredNorm() - radius * radius;
        if (b * b < c) continue;
        const double to = -b + std::sqrt(b * b - c);
        if (formulas_.beyond_wall_mm(from + to * turn.col(2)) < -0.5)
          first = std::min(first, to + planned_.reamer.behind_mm(std::hypot(x, y)));
      }
    return first;
  }

  /// Coverage that falls across the reamer's surface within a voxel.
  std::vector<uint8_t> left_by(const Pose& end) const {
    std::vector<uint8_t> left = bone_.coverage;
    const Pose tool_from_grid = end.inverse() * bone_.grid.world_from_grid;
    const ReamerShape& reamer = planned_.reamer;
    const double voxel_mm = bone_.grid.spacing_mm.x();
    for (size_t i = 0; i < left.size(); ++i) {
      if (left[i] == 0) continue;
      const Vec3 p = tool_from_grid.point(bone_.grid.centre_mm(bone_.grid.coordinates(i)));
      const double r = std::hypot(p.x(), p.y());
      if (r > reamer.outer_mm + voxel_mm) continue;
      const double slope = (reamer.behind_mm(r + 0.01) - reamer.behind_mm(r)) / 0.01;
      const double beyond =
          std::max((p.z() + reamer.behind_mm(r)) / std::hypot(1.0, slope), r - reamer.outer_mm);
      const double level = std::floor(128.0 + 255.0 * beyond / voxel_mm);
      left[i] = std::min(left[i], static_cast<uint8_t>(std::clamp(level, 0.0, 255.0)));
    }
    return left;
  }

  score::MetricsAccumulator ticks_to(const Pose& end, const Stray& stray) const {
    score::MetricsAccumulator ticks(bone_.grid.voxel_volume_mm3(), plan_pose().inverse());
    const double way_mm = std::max(advance_mm, planned_.plan.depth_mm + stray.depth_mm);
    const auto overloaded = static_cast<int>(stray.overload_s / tick_s);
    const int cuts = std::max(static_cast<int>(way_mm / advance_mm), overloaded);
    for (int i = 0; i <= cuts; ++i) {
      record::TickReport r;
      r.engaged = r.spindle_on = r.cutting = true;
      r.thrust_n = i < overloaded ? 90.0 : stray.thrust_n;
      r.surface_temperature_c = stray.surface_c;
      r.coverage_removed[0] = 100;
      r.changed_bricks = 1;
      r.world_from_tool = {end.rotation,
                           end.translation_mm - (way_mm * (1.0 - 1.0 * i / cuts)) * end.rotation.col(2)};
      ticks.add(r);
    }
    return ticks;
  }

  PlannedReaming planned_;
  GlenoidFormulas formulas_;
  voxel::BoneModel bone_;
  score::NativeGlenoid native_;
  score::PlannedFace planned_face_;
};

}  // namespace ream::test
