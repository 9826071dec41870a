// Whether the standard rubric puts sessions in the order in which a surgeon would: what is nearer the plan
// scores more, and what is no longer safe never passes.
#include <gtest/gtest.h>

#include <cstdio>

#include "score/rubric_score.hpp"
#include "support/executed_plan.hpp"
#include "support/full_tests.hpp"
#include "support/seed.hpp"

namespace ream::score {
namespace {

using test::ExecutedPlan;
using test::Stray;

constexpr double voxel_mm = 0.4;
const unsigned plan_count = test::tried_of(20u, 8u);

/// Sound plans of seeded glenoids, in turn: a round reamer of the whole face, and a component that is well
/// seated if the plan is carried out.
class Plans {
 public:
  ExecutedPlan next() {
    for (;; ++seed_) {
      const test::PlannedReaming planned = plan_of(seed_);
      if (planned.reamer.across_mm != planned.reamer.along_mm) continue;
      ExecutedPlan plan(planned, voxel_mm);
      if (plan.untouched().at("seating_planned_percent").get<double>() < 85.0) continue;
      ++seed_;
      return plan;
    }
  }
  unsigned seed() const { return seed_ - 1; }  ///< of the last

  static test::PlannedReaming plan_of(unsigned seed) {
    test::PlannedReaming planned = test::random_reaming(seed, voxel_mm);
    planned.plan.implant_radius_mm.reset();
    planned.plan.depth_mm = 1.4 + 0.03 * seed;
    return planned;
  }

 private:
  unsigned seed_ = 0;
};

Score judged(const nlohmann::json& metrics) { return apply_rubric(standard_rubric(), metrics); }

std::string lines_of(const Score& score) {
  std::string text;
  for (const CriterionScore& c : score.criteria)
    text += c.criterion.metric + " " + (c.value ? std::to_string(*c.value) : c.missing_reason) + " -> " +
            (c.points ? std::to_string(*c.points) : "-") + "\n";
  return text;
}

Stray along(double Stray::*error, double value) {
  Stray stray;
  stray.*error = value;
  return stray;
}

void expect_order(const ExecutedPlan& plan) {
  const auto score = [&](const Stray& stray) { return judged(plan.metrics(stray)); };
  const Score ideal = score({});
  ASSERT_TRUE(ideal.points);
  EXPECT_GE(*ideal.points, 95.0) << lines_of(ideal);
  EXPECT_EQ(ideal.outcome, Outcome::pass) << lines_of(ideal);
  struct Error {
    const char* name;
    double Stray::*error;
    std::vector<double> values;  ///< ever worse; the last never passes
  };
  const Error errors[] = {
      {"version", &Stray::version_deg, {2.0, 5.0, 11.0}},
      {"inclination", &Stray::inclination_deg, {-2.0, -5.0, -11.0}},
      {"entry", &Stray::superior_mm, {1.0, 2.0, 4.5}},
      {"too deep", &Stray::depth_mm, {0.3, 0.6, 1.2}},
      {"too shallow", &Stray::depth_mm, {-0.2, -0.5, -1.1}},
  };
  for (const Error& error : errors) {
    double before = *ideal.points;
    for (const double value : error.values) {
      const Score strayed = score(along(error.error, value));
      ASSERT_TRUE(strayed.points);
      EXPECT_LT(*strayed.points, before) << error.name << " " << value << "\n" << lines_of(strayed);
      before = *strayed.points;
      if (value != error.values.back()) continue;
      EXPECT_NE(strayed.outcome, Outcome::pass) << error.name << " " << value << "\n" << lines_of(strayed);
    }
  }
}

TEST(StandardRubric, PutsSessionsInOrder) {
  Plans plans;
  for (unsigned n = 0; n < plan_count; ++n) {
    const ExecutedPlan plan = plans.next();
    SCOPED_TRACE("seed " + std::to_string(plans.seed()));
    expect_order(plan);
  }
}

/// What a review found that the first standard rubric let pass.
TEST(StandardRubric, WhatOnceScoredTooMuchDoesNotAnyMore) {
  test::PlannedReaming planned = Plans::plan_of(0);
  planned.plan.depth_mm = 1.0;
  const ExecutedPlan plan(planned, voxel_mm);
  const Score nothing = judged(plan.untouched());
  EXPECT_FALSE(nothing.points) << "nothing was touched, which once gave 75 points";
  EXPECT_EQ(nothing.outcome, Outcome::undecided);
  const Score touch = judged(plan.metrics(along(&Stray::depth_mm, -0.95)));
  EXPECT_EQ(touch.outcome, Outcome::fail) << "a touch, once 95.7 points\n" << lines_of(touch);
  EXPECT_LT(*touch.points, 70.0) << lines_of(touch);
  for (const double deep_mm : {0.95, 1.39, 2.23, 8.2}) {
    const Score deep = judged(plan.metrics(along(&Stray::depth_mm, deep_mm)));
    EXPECT_EQ(deep.outcome, Outcome::fail) << deep_mm << " mm too deep, once passed\n" << lines_of(deep);
  }
}

TEST(StandardRubric, PointsFallEvenly) {
  const ExecutedPlan plan = Plans().next();
  for (double Stray::*error : {&Stray::depth_mm, &Stray::superior_mm, &Stray::anterior_mm}) {
    std::optional<double> before;
    for (int i = 0; i <= 10; ++i) {
      const double points = *judged(plan.metrics(along(error, 0.1 * i))).points;
      // No single criterion weighs more than 4 of 29.
      EXPECT_LE(points, before.value_or(points)) << 0.1 * i << " mm";
      EXPECT_GT(points, before.value_or(points) - 4.0) << 0.1 * i << " mm";
      before = points;
    }
  }
}

/// The plan turns the face; who turns it half the way has corrected half of its version.
TEST(StandardRubric, HalfACorrectionScoresLessThanTheWhole) {
  Plans plans;
  for (int n = 0; n < 5; ++n) {
    const ExecutedPlan plan = plans.next();
    const nlohmann::json whole = plan.metrics({});
    const double planned_deg = whole.at("version_planned_deg"),
                 native_deg = Plans::plan_of(plans.seed()).glenoid.shoulder.version_deg;
    const double half_deg = 0.5 * (native_deg - planned_deg);
    // Which way an axis turns for retroversion differs by side.
    nlohmann::json half = plan.metrics(along(&Stray::version_deg, half_deg));
    const auto off = [&](const nlohmann::json& metrics) {
      return std::abs(metrics.at("version_achieved_deg").get<double>() - (planned_deg + half_deg));
    };
    if (off(half) > 0.1) half = plan.metrics(along(&Stray::version_deg, -half_deg));
    ASSERT_LT(off(half), 0.1) << "seed " << plans.seed();
    EXPECT_LT(*judged(half).points, *judged(whole).points) << "seed " << plans.seed();
  }
}

TEST(StandardRubric, ForceAndHeatCostALittle) {
  const ExecutedPlan plan = Plans().next();
  const double ideal = *judged(plan.metrics({})).points;
  double before = ideal;
  for (const double thrust_n : {80.0, 95.0, 104.0}) {
    const double points = *judged(plan.metrics(along(&Stray::thrust_n, thrust_n))).points;
    EXPECT_LT(points, before) << thrust_n;
    before = points;
  }
  EXPECT_LT(*judged(plan.metrics(along(&Stray::thrust_n, 15.0))).points, ideal);
  EXPECT_LT(*judged(plan.metrics(along(&Stray::overload_s, 2.0))).points, ideal);
  Stray hot = along(&Stray::overload_s, 2.0);
  hot.surface_c = 60.0;
  EXPECT_LT(*judged(plan.metrics(hot)).points, *judged(plan.metrics(along(&Stray::overload_s, 2.0))).points);
}

/// Cap, component and pegs: what the bone loses by going too deep, in figures.
TEST(StandardRubric, JudgesBoneThatIsGone) {
  Plans plans;
  const ExecutedPlan plan = plans.next();
  const nlohmann::json ideal = plan.metrics({}), deep = plan.metrics(along(&Stray::depth_mm, 2.0));
  const auto value = [](const nlohmann::json& metrics, const char* key) {
    return metrics.at(key).get<double>();
  };
  EXPECT_NEAR(value(ideal, "vault_depth_mm") - value(deep, "vault_depth_mm"), 2.0, 0.2);
  EXPECT_EQ(value(ideal, "perforated_area_mm2"), 0.0);
  EXPECT_NEAR(value(ideal, "plate_lost_percent"), 0.0, 3.0);
  EXPECT_GT(value(deep, "plate_lost_percent"), 15.0);
  EXPECT_EQ(value(ideal, "depth_planned_mm"), Plans::plan_of(plans.seed()).plan.depth_mm);
  EXPECT_NEAR(value(ideal, "seating_short_percent"), 0.0, 2.0);
  const nlohmann::json through = plan.metrics(along(&Stray::depth_mm, 30.0));
  EXPECT_GT(value(through, "perforated_area_mm2"), 50.0);
  EXPECT_EQ(judged(through).outcome, Outcome::fail);
  const nlohmann::json turned = plan.metrics(along(&Stray::version_deg, 20.0));
  const double achieved = std::abs(value(turned, "version_achieved_deg")),
               allowed = std::max(7.0, std::abs(value(turned, "version_planned_deg")));
  EXPECT_NEAR(value(turned, "version_excess_deg"), std::max(0.0, achieved - allowed), 1e-5);
}

/// Whatever else is right, what is malpositioned or goes much too deep does not pass.
TEST(StandardRubric, NothingMalpositionedPasses) {
  std::mt19937 random(test::seed(77));
  std::uniform_real_distribution<double> small(-1.0, 1.0), large(1.05, 1.6);
  Plans plans;
  for (unsigned n = 0; n < 8; ++n) {
    const ExecutedPlan plan = plans.next();
    for (int kind = 0; kind < 4; ++kind) {
      Stray stray;
      stray.version_deg = 3.0 * small(random);
      stray.inclination_deg = 3.0 * small(random);
      stray.superior_mm = small(random);
      stray.anterior_mm = small(random);
      stray.depth_mm = 0.2 * small(random);
      if (kind == 0) stray.version_deg = 10.0 * large(random) + 2.0;
      if (kind == 1) stray.inclination_deg = -10.0 * large(random) - 2.0;
      if (kind == 2) stray.superior_mm = 4.0 * large(random);
      if (kind == 3) stray.depth_mm = 1.0 * large(random);
      const Score score = judged(plan.metrics(stray));
      EXPECT_NE(score.outcome, Outcome::pass) << "plan " << n << ", kind " << kind << "\n" << lines_of(score);
    }
  }
}

}  // namespace
}  // namespace ream::score
