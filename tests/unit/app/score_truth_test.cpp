// Scores against the truth: seeded reamings of phantoms, run headless, measured by the product in voxels and
// by support/reaming_truth in formulas.
#include <gtest/gtest.h>

#include <cstdlib>

#include "app/headless_run.hpp"
#include "case/landmarks.hpp"
#include "core/file.hpp"
#include "support/random_reaming.hpp"
#include "support/temporary_folder.hpp"

namespace ream::test {
namespace {

const double voxel_mm = std::getenv("REAM_VOXEL") ? atof(std::getenv("REAM_VOXEL")) : 0.2;

/// metrics.json of a reaming, and what must come out.
struct Scored {
  nlohmann::json metrics;
  ReamingTruth truth;
};

Scored run(const RandomReaming& reaming, const TemporaryFolder& folder) {
  const auto data = folder.path() / "data", out = folder.path() / "out";
  case_::Case c;
  c.id = c.name = "glenoid";
  c.side = reaming.glenoid.shoulder.side;
  c.bone = bone_of(reaming.glenoid, voxel_mm);
  c.plan = reaming.plan;
  case_::save_case(c, data / "cases/glenoid");
  case_::save_landmarks(shoulder_landmarks(reaming.glenoid.shoulder), data / "cases/glenoid");
  write_file_atomically(folder.path() / "script.json", reaming.script.dump());
  app::RunRequest request;
  request.case_name = "glenoid";
  request.script_name = (folder.path() / "script.json").string();
  request.backend = "cpu";
  request.tool_spacing_mm = 0.4;
  app::Rig rig(request, data);
  std::filesystem::create_directories(out);
  const std::vector<uint8_t> start = rig.bone_case.bone.coverage;
  const app::HeadlessResult result = app::run_headless(rig, start, out, false);
  return {result.metrics, reaming_truth(reaming, out / "trace.csv")};
}

class ScoreTruth : public testing::TestWithParam<unsigned> {};

TEST_P(ScoreTruth, IsWhatIsSaid) {
  const RandomReaming reaming = random_reaming(GetParam(), voxel_mm);
  SCOPED_TRACE("seed " + std::to_string(GetParam()) + ", " + reaming.plan.reamer);
  const TemporaryFolder folder;
  const auto [metrics, truth] = run(reaming, folder);
  const auto said = [&](const char* key) { return metrics.at(key).get<double>(); };
  EXPECT_NEAR(said("version_achieved_deg"), truth.version_deg, 0.2);
  EXPECT_NEAR(said("inclination_achieved_deg"), truth.inclination_deg, 0.2);
  EXPECT_NEAR(said("axis_error_deg"), truth.axis_error_deg, 0.2);
  EXPECT_NEAR(said("entry_error_mm"), truth.entry_error_mm, 0.1);
  EXPECT_NEAR(said("depth_max_mm"), truth.depth_max_mm, 0.5 * voxel_mm);
  EXPECT_NEAR(said("depth_mean_mm"), truth.depth_mean_mm, 0.5 * voxel_mm);
  EXPECT_NEAR(said("removed_volume_mm3"), truth.volume_mm3, 0.005 * truth.volume_mm3);
  EXPECT_NEAR(said("seating_percent"), truth.seating_percent, 1.0);
  EXPECT_NEAR(said("plate_preserved_percent"), truth.plate_percent, 2.0);
  EXPECT_NEAR(said("version_rim_deg"), truth.rim_version_deg, 0.2);
  EXPECT_NEAR(said("inclination_rim_deg"), truth.rim_inclination_deg, 0.2);
  if (std::getenv("REAM_TELL") != nullptr)
    std::printf(
        "TELL %3u %-32s v %7.3f %7.3f  e %6.3f %6.3f  dmax %6.3f %6.3f dmean %6.3f %6.3f  vol %8.2f "
        "%8.2f %+6.2f%%  seat %6.2f %6.2f  plate %6.2f %6.2f  rim %7.3f %7.3f %7.3f %7.3f area %7.2f %7.2f\n",
        GetParam(), reaming.plan.reamer.substr(0, 30).c_str(), said("version_achieved_deg"),
        truth.version_deg, said("entry_error_mm"), truth.entry_error_mm, said("depth_max_mm"),
        truth.depth_max_mm, said("depth_mean_mm"), truth.depth_mean_mm, said("removed_volume_mm3"),
        truth.volume_mm3, 100.0 * (said("removed_volume_mm3") / truth.volume_mm3 - 1.0),
        said("seating_percent"), truth.seating_percent, said("plate_preserved_percent"), truth.plate_percent,
        said("version_rim_deg"), truth.rim_version_deg, said("inclination_rim_deg"),
        truth.rim_inclination_deg, said("footprint_area_mm2"), truth.footprint_mm2);
}

INSTANTIATE_TEST_SUITE_P(Seeds, ScoreTruth,
                         testing::Range(unsigned{REAM_FIRST_SEED}, unsigned{REAM_LAST_SEED} + 1));

}  // namespace
}  // namespace ream::test
