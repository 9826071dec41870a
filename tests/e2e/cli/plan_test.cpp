#include <cmath>

#include "e2e/cli/command_line.hpp"

namespace ream::test {
namespace {

using nlohmann::json;

/// A biconcave phantom imported and planned by its landmarks.
class Planning : public CommandLine {
 protected:
  static constexpr double native_deg = -19.0;

  void SetUp() override {
    answer({"phantom", "--out", "ct", "--preset", "demo", "--spacing-mm", "1.0", "--format", "nrrd", "--type",
            "B2"});
    truth_ = json_of("ct/ground_truth.json");
    ASSERT_NEAR(truth_.at("version_deg").get<double>(), native_deg, 1.0);
    const auto c = truth_.at("glenoid").at("centre_mm").get<std::vector<double>>();
    const auto l = truth_.at("glenoid").at("lateral").get<std::vector<double>>();
    std::string seed;
    for (size_t k = 0; k < 3; ++k) seed += (k ? "," : "") + std::to_string(c[k] - 5.0 * l[k]);
    answer({"import", "ct/ct.nrrd", "--out", "b2", "--side", "right", "--threshold-hu", "150",
            "--grow-from=" + seed});
  }

  json truth_;
};

TEST_F(Planning, ByVersionAndInclinationOfTheLandmarks) {
  refuse(2, "--landmarks FILE", {"plan", "b2", "--version-deg", "0"});
  refuse(1, "missing.json", {"plan", "b2", "--landmarks", "missing.json"});
  refuse(2, "convex-40", {"plan", "b2", "--landmarks", "ct/landmarks.json", "--reamer", "spoon"});
  refuse(1, "refused from 15", {"plan", "b2", "--landmarks", "ct/landmarks.json", "--version-deg", "0"});

  const json plan = answer({"plan", "b2", "--landmarks", "ct/landmarks.json", "--version-deg", "-8",
                            "--inclination-deg", "4", "--implant-radius-mm", "45"});
  EXPECT_EQ(plan.at("reamer"), "convex-45");
  EXPECT_EQ(plan.at("version_deg"), -8.0);
  const json& assessment = plan.at("assessment");
  EXPECT_NEAR(assessment.at("version_before_deg").get<double>(), truth_.at("version_deg").get<double>(),
              1e-6);
  EXPECT_NEAR(assessment.at("version_after_deg").get<double>(), -8.0, 1e-6);
  EXPECT_NEAR(assessment.at("correction_deg").get<double>(), -8.0 - truth_.at("version_deg").get<double>(),
              0.2);
  EXPECT_EQ(assessment.at("needs_override"), false);
  EXPECT_FALSE(plan.at("measures").at("biconcavity").is_null());
  EXPECT_EQ(json_of("data/cases/b2/landmarks.json"), json_of("ct/landmarks.json")) << "kept with the case";

  refuse(1, "a depth of 90.0 mm goes through the bone", {"plan", "b2", "--depth-mm", "90"});
  const json deep = answer({"plan", "b2", "--depth-mm", "90", "--override", "a bad example"});
  EXPECT_EQ(deep.value("override", false), false) << "a reason for the depth is none for the angle";
  succeed({"plan", "b2", "--implant", "pegged medium"});
  refuse(1, "refused from 15", {"plan", "b2", "--version-deg", "0", "--depth-mm", "1"});
  const Outcome words = succeed({"plan", "b2", "--depth-mm", "1"});
  EXPECT_NE(words.out.find("retroversion"), std::string::npos) << words.out;
  EXPECT_NE(words.error.find("by reaming alone"), std::string::npos) << words.error;
  EXPECT_EQ(json_of("data/cases/b2/plan.json").at("version_deg"), -8.0) << "what is not asked for stays";
}

TEST_F(CommandLine, ThePlanOfTheDemoChangesOnlyWhereThatIsWanted) {
  const json before = answer({"plan", "demo"});
  refuse(1, "--replace", {"plan", "demo", "--depth-mm", "2"});
  refuse(1, "--replace", {"plan", "data/cases/demo", "--depth-mm", "2"});
  EXPECT_EQ(answer({"plan", "demo"}), before);
  EXPECT_EQ(answer({"plan", "demo", "--depth-mm", "2", "--replace"}).at("depth_mm"), 2.0);
}

TEST_F(Planning, AnOverrideIsKeptWithItsReason) {
  answer({"plan", "b2", "--landmarks", "ct/landmarks.json", "--version-deg", "0", "--override",
          "teaching case"});
  const json plan = json_of("data/cases/b2/plan.json");
  EXPECT_EQ(plan.at("override"), true);
  EXPECT_EQ(plan.at("override_reason"), "teaching case");
  const json metrics = answer({"simulate", "--case", "b2", "--script", short_script(), "--out", "out"});
  EXPECT_TRUE(metrics.contains("removed_volume_mm3"));
}

}  // namespace
}  // namespace ream::test
