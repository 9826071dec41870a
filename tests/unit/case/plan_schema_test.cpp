#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "case/case.hpp"
#include "case/plan.hpp"
#include "core/file.hpp"
#include "core/units.hpp"
#include "support/expect_error.hpp"
#include "support/json_schema.hpp"
#include "support/places.hpp"

namespace ream::case_ {
namespace {

using nlohmann::json;

json schema(const std::string& name) {
  return read_json_file(test::source_folder() + "/proto/" + name + ".schema.json");
}

json plan_with_everything() {
  return {{"entry_mm", {1.5, 2, 3}},     {"axis_direction", {0, 0, 1}}, {"depth_mm", 2},
          {"reamer", "convex-40"},       {"pilot_diameter_mm", 6.2},    {"pilot_depth_mm", 12},
          {"guide", "nipple"},           {"implant_radius_mm", 40},     {"implant_size", "M40"},
          {"version_deg", -3.3},         {"inclination_deg", 10},       {"override", true},
          {"override_reason", "a study"}};
}

TEST(PlanSchema, EveryKeyIsReadWrittenAndTaken) {
  const json whole = plan_with_everything(), rules = schema("plan");
  EXPECT_EQ(test::schema_faults(rules, whole), std::vector<std::string>{});
  const Plan plan = plan_from_json(whole, "p");
  EXPECT_EQ(plan.implant_size, "M40");
  EXPECT_EQ(*plan.implant_radius_mm, 40.0);
  EXPECT_NEAR(degrees_from_radians(*plan.target_version_rad), -3.3, 1e-12);
  EXPECT_TRUE(plan.override_correction);
  EXPECT_EQ(plan.override_reason, "a study");
  EXPECT_EQ(to_json(plan), whole);
}

TEST(PlanSchema, AnglesOfAPlanKeepTheirDigits) {
  json value = plan_with_everything();
  for (int tenths = -600; tenths <= 600; ++tenths) {
    value["version_deg"] = tenths / 10.0;
    EXPECT_EQ(to_json(plan_from_json(value, "p")).at("version_deg"), tenths / 10.0);
  }
}

TEST(PlanSchema, AnOldPlanKeepsItsBytes) {
  const std::string old =
      "{\n  \"axis_direction\": [\n    0.0,\n    0.6,\n    0.8\n  ],\n  \"depth_mm\": 1.0,\n  \"entry_mm\": "
      "[\n"
      "    -150.0,\n    -10.0,\n    20.0\n  ],\n  \"pilot_depth_mm\": 12.0,\n  \"pilot_diameter_mm\": 6.2,\n"
      "  \"reamer\": \"ellipse 18.25,9\"\n}";
  EXPECT_EQ(to_json(plan_from_json(json::parse(old), "p")).dump(2), old);
}

TEST(PlanSchema, SchemaAndReaderRefuseTheSame) {
  const json rules = schema("plan"), good = plan_with_everything();
  const std::vector<std::pair<std::string, json>> wrong{
      {"implant_radius_mm", 0},    {"implant_radius_mm", 101},
      {"implant_radius_mm", "40"}, {"implant_size", 3},
      {"version_deg", 61},         {"version_deg", "-3"},
      {"inclination_deg", -61},    {"override", "yes"},
      {"override_reason", 1},      {"speed", 3}};
  for (const auto& [key, value] : wrong) {
    json bad = good;
    bad[key] = value;
    EXPECT_FALSE(test::schema_faults(rules, bad).empty()) << key << " " << value;
    test::expect_error(ErrorKind::invalid_input, key, [&] { plan_from_json(bad, "place"); });
  }
  json unasked = good;
  unasked.erase("override");
  EXPECT_FALSE(test::schema_faults(rules, unasked).empty());
  test::expect_error(ErrorKind::invalid_input, "override", [&] { plan_from_json(unasked, "place"); });
}

TEST(CalibrationJson, OldFilesReadAsTodayAndNewKeysAreKept) {
  const json old = {{"intercept_mg_cc", 1.5}, {"slope_mg_cc_per_hu", 0.7}, {"threshold_hu", 180}};
  const Calibration c = calibration_from_json(old, "c"), standard;
  EXPECT_EQ(c.intercept_mg_cc, 1.5);
  EXPECT_EQ(c.ash_law, "Schileo 2008");
  EXPECT_EQ(c.ash_slope, standard.ash_slope);
  EXPECT_EQ(c.ash_per_apparent, standard.ash_per_apparent);
  json own = to_json(c);
  own["scanner"] = "scanner A, phantom B";
  own["ash_law"] = "our own";
  own["ash_intercept_g_cc"] = 0.05;
  own["ash_slope"] = 0.9;
  own["ash_per_apparent"] = 0.6;
  EXPECT_EQ(to_json(calibration_from_json(own, "c")), own);
  const json rules = schema("case"), part = rules.at("properties").at("calibration");
  for (const json& good : {old, own})
    EXPECT_EQ(test::schema_faults(part, good, rules), std::vector<std::string>{});
  const std::vector<std::pair<std::string, json>> wrong{
      {"slope_mg_cc_per_hu", 0}, {"ash_slope", -1},          {"ash_per_apparent", 0},
      {"ash_per_apparent", 1.1}, {"ash_intercept_g_cc", 11}, {"ash_law", 3},
      {"scanner", nullptr},      {"intercept_mg_cc", 1e7},   {"colour", 1}};
  for (const auto& [key, value] : wrong) {
    json bad = own;
    bad[key] = value;
    EXPECT_FALSE(test::schema_faults(part, bad, rules).empty()) << key << " " << value;
    test::expect_error(ErrorKind::invalid_input, key, [&] { calibration_from_json(bad, "place"); });
  }
}

}  // namespace
}  // namespace ream::case_
