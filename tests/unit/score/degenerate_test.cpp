// Sessions that say little: every metric has a number or a reason, never anything that is no number; and what
// a mirrored case says is the same.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "score/bone_results.hpp"
#include "score/metric_catalogue.hpp"
#include "score/metrics.hpp"
#include "support/analytic_glenoid.hpp"
#include "support/random_pose.hpp"
#include "support/seed.hpp"
#include "support/tick_reports.hpp"

namespace ream::score {
namespace {

using test::AnalyticGlenoid;

constexpr double block_voxel_mm = 0.5;

Task degenerate_task_on(const AnalyticGlenoid& glenoid) {
  Task task;
  task.anatomy.side = glenoid.shoulder.side;
  task.anatomy.landmarks = test::shoulder_landmarks(glenoid.shoulder);
  task.anatomy.glenoid = case_::glenoid_frame(*task.anatomy.landmarks, task.anatomy.side);
  case_::Plan plan;
  plan.entry_mm = glenoid.mirrored(glenoid.frame().centre);
  plan.axis_direction = glenoid.mirrored(-glenoid.frame().n);
  plan.implant_radius_mm = 32.0;
  task.plan = plan;
  task.reamer = shell::make_tool("sphere 30,11").profile;
  return task;
}

Pose world_from_plan(const Task& task) {
  if (!task.plan) return {};
  return {rotation_with_z_along(task.plan->axis_direction), task.plan->entry_mm};
}

/// All of metrics.json is a finite number, or null with a reason.
void expect_sound(const nlohmann::json& metrics, const std::string& what) {
  for (const Metric& metric : metric_catalogue()) {
    const std::string key(metric.key);
    ASSERT_TRUE(metrics.contains(key)) << what << ": " << key;
    if (metrics[key].is_null()) {
      ASSERT_TRUE(metrics["missing"].contains(key)) << what << ": " << key;
      EXPECT_FALSE(metrics["missing"][key].get<std::string>().empty());
    } else {
      ASSERT_TRUE(metrics[key].is_number()) << what << ": " << key;
      EXPECT_TRUE(std::isfinite(metrics[key].get<double>())) << what << ": " << key;
      EXPECT_FALSE(metrics["missing"].contains(key)) << what << ": " << key;
    }
  }
  EXPECT_EQ(metrics.dump().find("nan"), std::string::npos) << what;
}

nlohmann::json scored(const Task& task, const voxel::BoneModel& native, const std::vector<uint8_t>& left,
                      const MetricsAccumulator& ticks) {
  const NativeGlenoid glenoid(task, native);
  const MetricResults results = bone_results(glenoid, planned_face(glenoid), {native.grid, left.data()},
                                             ticks.cut_line(), world_from_plan(task));
  return session_metrics_json(ticks, results, 1.0, nullptr);
}

MetricsAccumulator no_ticks(const Task& task) { return {0.1, world_from_plan(task).inverse()}; }

/// A straight cut to some depth along the plan, tilted.
MetricsAccumulator straight_cut(const Task& task, double depth_mm, const Vec3& tilt_rad = Vec3::Zero()) {
  MetricsAccumulator ticks = no_ticks(task);
  for (int i = 0; i <= 200; ++i) {
    record::TickReport r;
    r.engaged = r.spindle_on = true;
    r.thrust_n = 50.0;
    r.changed_bricks = 1;
    r.coverage_removed[0] = 100;
    r.world_from_tool = world_from_plan(task) *
                        Pose{rotation_from_small_vector(tilt_rad), Vec3(0.3, -0.2, depth_mm * i / 200.0)};
    ticks.add(r);
  }
  return ticks;
}

TEST(DegenerateSession, ThatNeverTouchedBoneSaysSo) {
  const AnalyticGlenoid glenoid;
  const voxel::BoneModel bone = test::bone_of(glenoid, block_voxel_mm);
  const Task task = degenerate_task_on(glenoid);
  const nlohmann::json metrics = scored(task, bone, bone.coverage, no_ticks(task));
  expect_sound(metrics, "untouched");
  for (const char* key :
       {"seating_percent", "version_achieved_deg", "congruity_mm", "plate_preserved_percent"})
    EXPECT_EQ(metrics["missing"][key], "no bone was removed");
  EXPECT_TRUE(metrics["version_planned_deg"].is_number()) << "the plan says something all the same";
}

TEST(DegenerateSession, ThatLeftNoBoneSaysSo) {
  const AnalyticGlenoid glenoid;
  const voxel::BoneModel bone = test::bone_of(glenoid, block_voxel_mm);
  const Task task = degenerate_task_on(glenoid);
  const nlohmann::json metrics =
      scored(task, bone, std::vector<uint8_t>(bone.coverage.size(), 0), straight_cut(task, 20.0));
  expect_sound(metrics, "all gone");
  EXPECT_TRUE(metrics["seating_percent"].is_null());
  EXPECT_TRUE(metrics["congruity_mm"].is_null());
  EXPECT_EQ(metrics["plate_preserved_percent"], 0.0);
  EXPECT_GT(metrics["reaming_depth_mm"].get<double>(), 15.0);
}

TEST(DegenerateSession, AbortedInItsFirstTicksSaysWhatItCan) {
  const AnalyticGlenoid glenoid;
  const voxel::BoneModel bone = test::bone_of(glenoid, block_voxel_mm);
  const Task task = degenerate_task_on(glenoid);
  MetricsAccumulator ticks = no_ticks(task);
  record::TickReport r;
  r.engaged = r.spindle_on = true;
  r.coverage_removed[1] = 1;
  r.changed_bricks = 1;
  r.world_from_tool = world_from_plan(task);
  ticks.add(r);
  expect_sound(scored(task, bone, bone.coverage, ticks), "one tick");
}

TEST(DegenerateSession, WithoutLandmarksOrPlanSaysWhatItCan) {
  const AnalyticGlenoid glenoid;
  const voxel::BoneModel bone = test::bone_of(glenoid, block_voxel_mm);
  Task task = degenerate_task_on(glenoid);
  task.anatomy.landmarks.reset();
  nlohmann::json metrics = scored(task, bone, bone.coverage, straight_cut(task, 1.0));
  expect_sound(metrics, "no landmarks");
  EXPECT_NE(metrics["missing"]["version_error_deg"].get<std::string>().find("trigonum"), std::string::npos);
  EXPECT_TRUE(metrics["axis_error_deg"].is_number());
  task.anatomy.glenoid.reset();
  metrics = scored(task, bone, bone.coverage, straight_cut(task, 1.0));
  expect_sound(metrics, "no glenoid frame");
  EXPECT_TRUE(metrics["plan_correction_deg"].is_null());

  Task planless = degenerate_task_on(glenoid);
  planless.plan.reset();
  metrics = scored(planless, bone, bone.coverage, straight_cut(planless, 1.0));
  expect_sound(metrics, "no plan");
  EXPECT_EQ(metrics["missing"]["axis_error_deg"], "the case has no plan");
}

TEST(DegenerateSession, OfAPlanBesideTheBoneSaysSo) {
  const AnalyticGlenoid glenoid;
  const voxel::BoneModel bone = test::bone_of(glenoid, block_voxel_mm);
  Task task = degenerate_task_on(glenoid);
  task.plan->entry_mm += 60.0 * Vec3::UnitZ();
  const nlohmann::json metrics = scored(task, bone, bone.coverage, straight_cut(task, 1.0));
  expect_sound(metrics, "beside");
  EXPECT_NE(metrics["missing"]["seating_percent"].get<std::string>().find("no face"), std::string::npos);
}

/// Random voxels, plans, landmarks and ticks: whatever comes, nothing unsound.
TEST(DegenerateSession, AnythingAtAllIsSound) {
  std::mt19937 random(test::seed());
  for (int n = 0; n < 40; ++n) {
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    AnalyticGlenoid glenoid;
    glenoid.shoulder.side = n % 2 == 0 ? case_::Side::right : case_::Side::left;
    voxel::BoneModel bone = test::bone_of(glenoid, 0.8);
    Task task = degenerate_task_on(glenoid);
    if (n % 3 == 0)
      for (uint8_t& c : bone.coverage) c = random() % 2 == 0 ? static_cast<uint8_t>(random()) : 0;
    std::vector<uint8_t> left = bone.coverage;
    for (uint8_t& c : left)
      if (random() % 4 == 0) c = static_cast<uint8_t>(c * (random() % 256) / 256);
    task.plan->axis_direction =
        (task.plan->axis_direction + 1.5 * number(random) * test::random_vector(random, 1.0)).normalized();
    task.plan->entry_mm += test::random_vector(random, 8.0);
    if (n % 4 == 0) task.plan->implant_radius_mm = std::abs(30.0 * number(random));
    if (n % 5 == 0) task.anatomy.landmarks->trigonum_mm = task.anatomy.landmarks->glenoid_centre_mm;
    if (n % 7 == 0) task.anatomy.landmarks->anterior_rim_mm = task.anatomy.landmarks->posterior_rim_mm;
    MetricsAccumulator ticks = no_ticks(task);
    for (uint32_t tick = 0; tick < 300; ++tick) {
      record::TickReport r = test::random_report(random, tick);
      r.world_from_bone_rest = {};
      r.world_from_tool = world_from_plan(task) * test::random_pose(random, 5.0);
      ticks.add(r);
    }
    expect_sound(scored(task, bone, left, ticks), "case " + std::to_string(n));
  }
}

/// The same bone, plan and cut in a mirror: the same numbers to the last digit that is given.
TEST(MirroredCase, HasIdenticalScores) {
  std::mt19937 random(test::seed());
  for (int n = 0; n < 6; ++n) {
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    AnalyticGlenoid right;
    right.shoulder.version_deg = 8.0 * number(random);
    right.shoulder.inclination_deg = 8.0 * number(random);
    const Vec3 tilt(0.08 * number(random), 0.08 * number(random), 0.0);
    const Vec3 aside(number(random), number(random), 1.2);
    const auto score_of = [&](case_::Side side) {
      AnalyticGlenoid glenoid = right;
      glenoid.shoulder.side = side;
      voxel::BoneModel bone = test::bone_of(glenoid, block_voxel_mm);
      Task task = degenerate_task_on(glenoid);
      // The tool's deepest pose, in the right shoulder's plan frame; a left one's is its mirror image.
      Task right_task = degenerate_task_on(right);
      const Pose pose = world_from_plan(right_task) * Pose{rotation_from_small_vector(tilt), aside};
      const auto mirror = [&](const Vec3& v) { return glenoid.mirrored(v); };
      const Vec3 apex = mirror(pose.translation_mm), axis = mirror(pose.rotation.col(2));
      std::vector<uint8_t> left = bone.coverage;
      for (size_t i = 0; i < left.size(); ++i) {
        const Vec3 p = bone.grid.world_from_grid.point(bone.grid.centre_mm(bone.grid.coordinates(i)));
        const Vec3 offset = p - (apex - 30.0 * axis);
        const double beyond =
            std::max(offset.norm() - 30.0, (offset - offset.dot(axis) * axis).norm() - 11.0);
        left[i] = std::min(
            left[i], static_cast<uint8_t>(std::clamp(127.5 + 255.0 * beyond / block_voxel_mm, 0.0, 255.0)));
      }
      CutLine line;
      const Pose plan_from_world = world_from_plan(task).inverse();
      line.apex_mm = plan_from_world.point(apex);
      line.direction = plan_from_world.direction(axis);
      line.deepest_mm = line.apex_mm.z();
      const NativeGlenoid native(task, bone);
      return bone_results(native, planned_face(native), {bone.grid, left.data()}, line, world_from_plan(task))
          .to_json();
    };
    const nlohmann::json of_right = score_of(case_::Side::right), of_left = score_of(case_::Side::left);
    EXPECT_TRUE(of_right["seating_percent"].is_number());
    EXPECT_EQ(of_right, of_left) << n;
  }
}

}  // namespace
}  // namespace ream::score
