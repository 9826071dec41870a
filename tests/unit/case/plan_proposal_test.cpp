#include "case/planning.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "case/measures.hpp"
#include "case/plan.hpp"
#include "shell/reamer_library.hpp"
#include "support/expect_error.hpp"
#include "support/shoulder_landmarks.hpp"
#include "support/test_bone.hpp"

namespace ream::case_ {
namespace {

using nlohmann::json;

double degrees(double rad) { return degrees_from_radians(rad); }

PlanAssessment assessed(const Plan& plan, const Landmarks& l) { return assess_plan(plan, l, Side::right); }

bool mentions(const PlanAssessment& a, const std::string& words) {
  for (const std::string& warning : a.warnings)
    if (warning.find(words) != std::string::npos) return true;
  return false;
}

PlanTargets aimed_at(double version_deg, double inclination_deg) {
  PlanTargets targets;
  targets.version_rad = radians_from_degrees(version_deg);
  targets.inclination_rad = radians_from_degrees(inclination_deg);
  return targets;
}

TEST(PlanProposal, ItsAxisHasTheWantedAnglesOnEitherSide) {
  for (const Side side : {Side::right, Side::left})
    for (const double version : {-9.0, 0.0, 4.0})
      for (const double inclination : {-5.0, 0.0, 8.0}) {
        const Landmarks l = test::shoulder_landmarks({.side = side});
        const Plan plan = propose_plan(aimed_at(version, inclination), l, side, {});
        const FaceAngles angles =
            face_angles(-plan.axis_direction, *l.glenoid_centre_mm, *l.trigonum_mm, *l.inferior_angle_mm);
        EXPECT_NEAR(degrees(angles.version_rad), version, 1e-9);
        EXPECT_NEAR(degrees(angles.inclination_rad), inclination, 1e-9);
        EXPECT_EQ(plan.entry_mm, *l.glenoid_centre_mm);
        const Plan read = plan_from_json(to_json(plan), "p");
        EXPECT_EQ(to_json(read).dump(), to_json(plan).dump());
        EXPECT_EQ(read.axis_direction, plan.axis_direction);
      }
}

TEST(PlanProposal, WithoutTargetsNeutralVersionAndTheInclinationThatIs) {
  for (const auto& [native, planned] : {std::pair{4.0, 4.0}, {14.0, 10.0}, {-3.0, -3.0}, {-18.0, -10.0}}) {
    const Landmarks l = test::shoulder_landmarks({.version_deg = -6, .inclination_deg = native});
    const Plan plan = propose_plan({}, l, Side::right, {});
    EXPECT_EQ(*plan.target_version_rad, 0.0);
    EXPECT_NEAR(degrees(*plan.target_inclination_rad), planned, 1e-9);
  }
}

TEST(PlanProposal, TheEntryIsWhereTheAxisMeetsTheSurface) {
  const Landmarks l = test::shoulder_landmarks({});
  Vec3 from, along;
  const Plan plan = propose_plan({}, l, Side::right, [&](const Vec3& p, const Vec3& d) {
    from = p;
    along = d;
    return std::optional<Vec3>(p + 59.0 * d);
  });
  EXPECT_LT((from + 60.0 * along - *l.glenoid_centre_mm).norm(), 1e-9);
  EXPECT_LT((plan.entry_mm - (*l.glenoid_centre_mm - plan.axis_direction)).norm(), 1e-9);
  test::expect_error(ErrorKind::invalid_input, "misses the bone", [&] {
    propose_plan({}, l, Side::right, [](const Vec3&, const Vec3&) { return std::nullopt; });
  });
  Landmarks fewer = l;
  fewer.trigonum_mm.reset();
  test::expect_error(ErrorKind::invalid_input, "trigonum_mm",
                     [&] { propose_plan({}, fewer, Side::right, {}); });
}

TEST(PlanProposal, TheReamerFollowsTheImplantAndTheGuideTheReamer) {
  const Landmarks l = test::shoulder_landmarks({});
  PlanTargets targets;
  targets.implant_radius_mm = 47.0;
  Plan plan = propose_plan(targets, l, Side::right, {});
  EXPECT_EQ(plan.reamer, "convex-45");
  EXPECT_EQ(plan.guide, GuideKind::nipple);
  EXPECT_EQ(*plan.implant_radius_mm, 47.0);
  targets.reamer = "cannulated-50";
  plan = propose_plan(targets, l, Side::right, {});
  EXPECT_EQ(plan.guide, GuideKind::pin);
  EXPECT_EQ(plan.pilot_hole->diameter_mm, 2.5);
  targets.reamer = "sphere 30";
  EXPECT_EQ(propose_plan(targets, l, Side::right, {}).guide, GuideKind::none);
  targets.guide = GuideKind::pin;
  targets.pilot_hole = PilotHole{5.0, 9.0};
  plan = propose_plan(targets, l, Side::right, {});
  EXPECT_EQ(plan.guide, GuideKind::pin);
  EXPECT_EQ(plan.pilot_hole->depth_mm, 9.0);
  targets.reamer = "cube";
  test::expect_error(ErrorKind::usage, "convex-40", [&] { propose_plan(targets, l, Side::right, {}); });
}

TEST(PlanTargets, AreReadStrictly) {
  const PlanTargets t = plan_targets_from_json({{"version_deg", -3},
                                                {"inclination_deg", 5},
                                                {"depth_mm", 1.5},
                                                {"implant_radius_mm", 40},
                                                {"implant_size", "M"},
                                                {"reamer", "thesis"},
                                                {"pilot_diameter_mm", 6},
                                                {"pilot_depth_mm", 10},
                                                {"guide", "pin"}},
                                               "body");
  EXPECT_NEAR(degrees(*t.version_rad), -3.0, 1e-12);
  EXPECT_EQ(t.pilot_hole->depth_mm, 10.0);
  EXPECT_EQ(*t.guide, GuideKind::pin);
  EXPECT_FALSE(plan_targets_from_json(json::object(), "body").version_rad);
  for (const json& bad : {json{{"version_deg", 41}}, json{{"version_deg", "3"}}, json{{"pilot_depth_mm", 3}},
                          json{{"guide", "rail"}}, json{{"speed", 1}}, json{{"depth_mm", -1}}})
    test::expect_error(ErrorKind::invalid_input,
                       bad.begin().key() == "pilot_depth_mm" ? "pilot_diameter_mm" : bad.begin().key(),
                       [&] { plan_targets_from_json(bad, "body"); });
}

TEST(PlanAssessment, CorrectionIsTheAngleBetweenFaceAndAxis) {
  const Landmarks l = test::shoulder_landmarks({.version_deg = -14, .inclination_deg = 0});
  for (const double version : {-14.0, -9.0, -4.0, -3.0, 0.0, 1.0, 5.0}) {
    const PlanAssessment a = assessed(propose_plan(aimed_at(version, 0.0), l, Side::right, {}), l);
    const double correction = version + 14.0;
    EXPECT_NEAR(degrees(*a.correction_rad), correction, 1e-7);
    EXPECT_NEAR(degrees(*a.version_before_rad), -14.0, 1e-9);
    EXPECT_NEAR(degrees(*a.version_after_rad), version, 1e-9);
    EXPECT_NEAR(degrees(*a.inclination_after_rad), 0.0, 1e-9);
    EXPECT_EQ(a.needs_override, correction >= 15.0) << version;
    EXPECT_EQ(mentions(a, "by reaming alone"), correction > 10.0) << version;
    EXPECT_EQ(mentions(a, "Clavert"), correction >= 15.0) << version;
  }
}

TEST(PlanAssessment, AMirroredShoulderIsJudgedTheSameToTheLastBit) {
  const auto judged = [](Side side) {
    const Landmarks l =
        test::shoulder_landmarks({.side = side, .version_deg = -13.3, .inclination_deg = 8.1});
    const Plan plan = propose_plan(aimed_at(-1.7, 2.9), l, side, {});
    return to_json(assess_plan(plan, l, side)).dump();
  };
  EXPECT_EQ(judged(Side::left), judged(Side::right));
}

TEST(PlanAssessment, FifteenDegreesNeedAnOverrideAndTenAreNotYetWarnedOf) {
  const Landmarks l = test::shoulder_landmarks({.version_deg = -15, .inclination_deg = 0});
  Plan plan = propose_plan(aimed_at(0, 0), l, Side::right, {});
  PlanAssessment a = assessed(plan, l);
  EXPECT_TRUE(a.needs_override);
  EXPECT_NE(why_refused(a).find("15.0\u00b0 retroversion"), std::string::npos) << why_refused(a);
  plan.override_correction = true;
  plan.override_reason = "study";
  a = assessed(plan, l);
  EXPECT_FALSE(a.needs_override);
  EXPECT_TRUE(mentions(a, "Clavert"));
  EXPECT_FALSE(mentions(assessed(propose_plan(aimed_at(-5, 0), l, Side::right, {}), l), "by reaming alone"));
}

TEST(PlanAssessment, RetroversionThatRemainsIsWarnedOf) {
  const Landmarks l = test::shoulder_landmarks({.version_deg = -18, .inclination_deg = 0});
  const auto with = [&](double version) {
    return assessed(propose_plan(aimed_at(version, 0), l, Side::right, {}), l);
  };
  EXPECT_FALSE(mentions(with(-7.0), "would remain"));
  EXPECT_TRUE(mentions(with(-7.5), "within 7"));
  EXPECT_TRUE(mentions(with(-15.0), "within 7"));
  EXPECT_TRUE(mentions(with(-15.5), "Ho 2013"));
}

TEST(PlanAssessment, APilotHoleThroughTheFarCortexIsWarnedOf) {
  voxel::BoneModel bone = test::slab({32, 32, 32}, 0.5, 12.0, 1.0);
  for (int w = 0; w < 4; ++w)  // bone from 2 to 12 mm
    for (int v = 0; v < 32; ++v)
      for (int u = 0; u < 32; ++u) bone.coverage[bone.grid.index(Vec3i(u, v, w))] = 0;
  Plan plan = test::slab_plan(bone, 12.0);
  EXPECT_NEAR(bone_depth_along(bone, plan.entry_mm, plan.axis_direction).value(), 10.0, 0.3);
  plan.pilot_hole = PilotHole{6.0, 9.0};
  PlanAssessment a = assess_plan(plan, {}, Side::right, &bone);
  EXPECT_NEAR(*a.vault_depth_mm, 10.0, 0.3);
  EXPECT_FALSE(mentions(a, "far cortex"));
  plan.pilot_hole->depth_mm = 11.0;
  EXPECT_TRUE(mentions(assess_plan(plan, {}, Side::right, &bone), "far cortex"));
  plan.entry_mm.z() += 40.0;
  a = assess_plan(plan, {}, Side::right, &bone);
  EXPECT_FALSE(a.vault_depth_mm);
  EXPECT_TRUE(mentions(a, "does not lie on the bone"));
}

TEST(PlanAssessment, TheReamerIsComparedWithTheGlenoid) {
  const Landmarks l = test::shoulder_landmarks({.height_mm = 35.0, .width_mm = 29.0});
  Plan plan = propose_plan({}, l, Side::right, {});
  EXPECT_FALSE(mentions(assessed(plan, l), "diameter"));
  plan.reamer = "convex-30";
  EXPECT_TRUE(mentions(assessed(plan, l), "smaller"));
  plan.reamer = "convex-60";
  EXPECT_TRUE(mentions(assessed(plan, l), "larger"));
  plan.reamer = "gone.stl";
  EXPECT_TRUE(mentions(assessed(plan, l), "cannot be judged"));
  plan.reamer = "cannulated-40";
  EXPECT_TRUE(mentions(assessed(plan, l), "by a pin"));
}

TEST(PlanAssessment, WithoutLandmarksTheGlenoidFrameStandsInAndNothingElseIsClaimed) {
  Plan plan;
  EXPECT_FALSE(assess_plan(plan, {}, Side::right).correction_rad);
  GlenoidFrame frame;
  frame.lateral = -plan.axis_direction;
  EXPECT_NEAR(*assess_plan(plan, {}, Side::right, nullptr, &frame).correction_rad, 0.0, 1e-12);
  plan.axis_direction = Vec3(1, 0.5, 0).normalized();
  const PlanAssessment a = assess_plan(plan, {}, Side::right, nullptr, &frame);
  EXPECT_TRUE(a.needs_override);
  EXPECT_EQ(to_json(a).at("version_after_deg"), nullptr);
  EXPECT_NEAR(to_json(a).at("correction_deg").get<double>(), degrees(std::atan(0.5)), 1e-9);
}

}  // namespace
}  // namespace ream::case_
