#include "e2e/cli/command_line.hpp"

namespace ream::test {
namespace {

using nlohmann::json;

/// From a CT on the disk to a reamed glenoid, one command after the other.
class Volumes : public CommandLine, public testing::WithParamInterface<const char*> {
 protected:
  static std::string list(std::initializer_list<double> numbers) {
    std::string text;
    for (const double number : numbers) text += (text.empty() ? "" : ",") + std::to_string(number);
    return text;
  }
};

TEST_P(Volumes, GoFromFileToReamedBone) {
  const std::string format = GetParam();
  const json made =
      answer({"phantom", "--out", "ct", "--spacing-mm", "1.0", "--format", format, "--side", "left"});
  const json glenoid = json_of("ct/ground_truth.json").at("glenoid");
  EXPECT_EQ(made.at("ground_truth").at("glenoid"), glenoid);
  const auto c = glenoid.at("centre_mm").get<std::vector<double>>();
  const auto l = glenoid.at("lateral").get<std::vector<double>>();

  const std::string path = format == "dicom" ? "ct" : format == "nrrd" ? "ct/ct.nrrd" : "ct/ct.nii.gz";
  // Without it the humeral head, which is larger in this region, would be kept.
  const std::string in_scapula = list({c[0] - 4 * l[0], c[1] - 4 * l[1], c[2] - 4 * l[2]});
  const std::string roi = list({c[0] - 30, c[1] - 30, c[2] - 30, c[0] + 30, c[1] + 30, c[2] + 30});
  const json imported = answer({"import", path, "--out", "left-shoulder", "--side", "left", "--roi=" + roi,
                                "--upsample", "2", "--sigma-mm", "0", "--grow-from=" + in_scapula});
  EXPECT_GT(imported.at("bone_voxels").get<int>(), 1000);
  EXPECT_EQ(imported.at("spacing_mm"), json({0.5, 0.5, 0.5}));
  EXPECT_EQ(imported.at("warnings"), json::array());

  refuse(1, "'left-shoulder' has no plan",
         {"simulate", "--case", "left-shoulder", "--script", short_script(), "--backend", "cpu", "--out",
          "out"});
  refuse(1, "case already", {"import", path, "--out", "left-shoulder"});
  refuse(1, "misses the bone", {"plan", "left-shoulder", "--axis", "900,0,0,0,0,1"});

  const json plan =
      answer({"plan", "left-shoulder", "--axis=" + list({c[0], c[1], c[2], -l[0], -l[1], -l[2]}), "--reamer",
              "sphere 20", "--depth-mm", "2", "--pilot-diameter-mm", "5", "--pilot-depth-mm", "9"});
  double off_mm = 0.0;
  for (size_t k = 0; k < 3; ++k) off_mm += std::abs(plan.at("entry_mm")[k].get<double>() - c[k]);
  EXPECT_LT(off_mm, 2.0) << "the axis meets the bone at the glenoid's centre";

  const json listed = answer({"list", "cases"});
  ASSERT_EQ(listed.size(), 1u);
  EXPECT_EQ(listed[0].at("id"), "left-shoulder");
  EXPECT_EQ(listed[0].at("side"), "left");
  EXPECT_EQ(listed[0].at("planned"), true);

  const json metrics = answer({"simulate", "--case", "left-shoulder", "--script", short_script(), "--backend",
                               "cpu", "--out", "out"});
  EXPECT_GT(metrics.at("removed_volume_mm3").get<double>(), 0.5);
  EXPECT_LT(metrics.at("reaming_depth_mm").get<double>(), 1.0) << "it only scratched the bone";
  EXPECT_EQ(json_of("out/session.json").at("side"), "left");
}

INSTANTIATE_TEST_SUITE_P(Formats, Volumes, testing::Values("dicom", "nrrd", "nifti"),
                         [](const auto& format) { return format.param; });

TEST_F(CommandLine, EveryCommandHelps) {
  for (const char* command :
       {"serve", "simulate", "phantom", "import", "plan", "voxelize", "list", "bench"}) {
    const Outcome outcome = succeed({command, "--help"});
    EXPECT_NE(outcome.out.find("--help"), std::string::npos) << command;
    EXPECT_EQ(outcome.error, "") << command;
  }
  EXPECT_EQ(succeed({"--version"}).out.rfind("ream ", 0), 0u);
}

}  // namespace
}  // namespace ream::test
