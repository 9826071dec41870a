// What a plan reaches by formulas, against a bone of voxels from which a reamer on that plan was taken away.
#include "score/plan_outcome.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "support/executed_plan.hpp"
#include "support/expect_error.hpp"

namespace ream::score {
namespace {

constexpr double outcome_voxel_mm = 0.4;
constexpr unsigned plan_count = 12;

/// Every figure, how far it may be off, and how far it was.
struct Bound {
  double bound, worst = 0.0;
};

TEST(PlanOutcome, IsWhatAnExactSessionReaches) {
  std::map<std::string, Bound> bounds = {{"medialization_mm", {0.5 * outcome_voxel_mm}},
                                         {"depth_mean_mm", {0.25 * outcome_voxel_mm}},
                                         {"seating_percent", {3.0}},
                                         {"plate_preserved_percent", {3.0}},
                                         {"joint_line_mm", {0.5 * outcome_voxel_mm}},
                                         {"vault_distance_component_mm", {0.5 * outcome_voxel_mm}}};
  for (unsigned seed = 0; seed < plan_count; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    test::PlannedReaming planned = test::random_reaming(seed, outcome_voxel_mm);
    planned.plan.depth_mm = 1.0 + 0.1 * seed;
    const test::ExecutedPlan plan(planned, outcome_voxel_mm);
    const nlohmann::json outcome = outcome_json(plan_outcome(plan.native())), reached = plan.metrics({});
    const double footprint_mm2 = reached.at("footprint_area_mm2").get<double>();
    // Half a voxel around the rim, which coverage blurs.
    const double edge_mm2 = 0.5 * outcome_voxel_mm * 2.0 * std::sqrt(pi * footprint_mm2);
    EXPECT_NEAR(outcome.at("footprint_area_mm2").get<double>(), footprint_mm2, edge_mm2);
    for (auto& [key, bound] : bounds) {
      ASSERT_TRUE(outcome.at(key).is_number()) << key;
      ASSERT_TRUE(reached.at(key).is_number()) << key;
      const double off = std::abs(outcome.at(key).get<double>() - reached.at(key).get<double>());
      EXPECT_LE(off, bound.bound) << key << ": " << outcome.at(key) << " against " << reached.at(key);
      bound.worst = std::max(bound.worst, off);
    }
  }
  for (const auto& [key, bound] : bounds) std::printf("%s: worst %.3f\n", key.c_str(), bound.worst);
}

TEST(PlanOutcome, OfAPlanThatMissesTheFaceIsNothing) {
  test::PlannedReaming planned = test::random_reaming(0, outcome_voxel_mm);
  planned.plan.entry_mm += 80.0 * rotation_with_z_along(planned.plan.axis_direction).col(0);
  const nlohmann::json outcome =
      outcome_json(plan_outcome(test::ExecutedPlan(planned, outcome_voxel_mm).native()));
  for (const auto& [key, value] : outcome.items()) EXPECT_TRUE(value.is_null()) << key;
}

TEST(PlanOutcome, AReamerThatWouldFillTheMemoryIsRefused) {
  const test::PlannedReaming planned = test::random_reaming(0, outcome_voxel_mm);
  Task task;
  task.plan = planned.plan;
  task.reamer = shell::make_tool("sphere 1000,1000").profile;
  test::expect_error(ErrorKind::invalid_input, "too wide for a glenoid",
                     [&] { NativeGlenoid(task, test::bone_of(planned.glenoid, outcome_voxel_mm)); });
}

TEST(PlanOutcome, DeeperTakesMoreAndLeavesLess) {
  test::PlannedReaming planned = test::random_reaming(1, outcome_voxel_mm);
  std::optional<MetricResults> before;
  for (const double planned_mm : {0.5, 1.5, 3.0}) {
    planned.plan.depth_mm = planned_mm;
    const MetricResults outcome = plan_outcome(test::ExecutedPlan(planned, outcome_voxel_mm).native());
    if (before) {
      EXPECT_GT(outcome.value("depth_mean_mm"), before->value("depth_mean_mm"));
      EXPECT_LE(outcome.value("plate_preserved_percent"), before->value("plate_preserved_percent"));
      EXPECT_LT(outcome.value("joint_line_mm"), before->value("joint_line_mm"));
    }
    ASSERT_TRUE(outcome.value("joint_line_mm"));
    before = outcome;
  }
}

}  // namespace
}  // namespace ream::score
