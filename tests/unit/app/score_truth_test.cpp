// Scores against the truth: seeded reamings of glenoids, run headless, measured by the product in voxels and
// by support/reaming_truth in formulas.
#include <gtest/gtest.h>
#include <random>

#include "app/headless_run.hpp"
#include "case/landmarks.hpp"
#include "core/file.hpp"
#include "record/recording.hpp"
#include "shell/swept_profile.hpp"
#include "support/random_reaming.hpp"
#include "support/temporary_folder.hpp"

namespace ream::test {
namespace {

constexpr double voxel_mm = 0.2;

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
  {
    const record::Recording rec(out / "recording.ream");
    std::vector<Pose> poses;
    const voxel::VoxelGrid grid = rec.grid();
    int64_t before = 0;
    rec.for_each_tick(0, UINT32_MAX, [&](const record::ops::Tick& t) {
      if (t.removed_cancellous + t.removed_cortical > 0) poses.push_back(dequantised(t.grid_from_tool));
      before += t.removed_cancellous + t.removed_cortical;
    });
    printf("POSES %zu  v=%f\n", poses.size(), double(before) / 255 * grid.voxel_volume_mm3());
    std::vector<Pose> inv;
    for (auto& q : poses) inv.push_back(q.inverse());
    const auto& profile = rig.model.tool.profile;
    const shell::SweptProfile table = shell::swept_profile(profile, 3.0);
    double sums[6] = {}, tabled = 0, real = 0;
    const GlenoidFormulas formulas(reaming.glenoid);
    std::mt19937 rnd(1);
    std::uniform_real_distribution<double> u(-1, 1);
    const auto& pr = reaming.reamer;
    long in_native = 0, cut = 0, hole = 0, N = 1500000;
    double covsum = 0;
    for (long n = 0; n < N; ++n) {
      const Vec3 q(13 * u(rnd), 13 * u(rnd), -3.0 + 3.5 * u(rnd));
      const Vec3 g = poses[deep].point(q);
      const Vec3 w = grid.world_from_grid.point(g);
      const bool solid = formulas.solid(w);
      in_native += solid;
      const Vec3i o = grid.voxel_at(g);
      if (grid.contains(o)) {
        covsum += start[grid.index(o)] / 255.0;
      }
      bool inside = false;
      for (size_t k = deep + 1; k-- > 0 && !inside;) {
        const Vec3 t = inv[k].point(g);
        const double r = std::hypot(t.x(), t.y());
        inside = r < pr.outer_mm && t.z() < -pr.behind_mm(r) && t.z() > -pr.behind_mm(pr.outer_mm) - 0.5;
        if (k > 10) k -= 5;
      }
      const Vec3 off = w - reaming.plan.entry_mm;
      const double along = off.dot(reaming.plan.axis_direction);
      const bool in_hole = reaming.plan.pilot_hole && (off - along * reaming.plan.axis_direction).norm() <
                                                          0.5 * reaming.plan.pilot_hole->diameter_mm;
      hole += in_hole && solid && inside;
      cut += solid && inside && !in_hole;
    }
    const double V = 26.0 * 26.0 * 7.0 / N;
    printf("MC native %f (coverage, hole gone %f) cut %f  in hole %f +- %f\n", in_native * V, covsum * V,
           cut * V, hole * V, std::sqrt(double(cut)) * V);
    const double f = grid.voxel_volume_mm3() / 255;
    printf("REAL %f TABLED %f wall %f floor %f far %f all %f filtered %f\n", real * f, tabled * f,
           sums[1] * f, sums[2] * f, sums[0] * f, sums[4] * f, sums[5] * f);
  }
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
  printf(
      "TELL %3u %-32s v %7.3f %7.3f  e %6.3f %6.3f  dmax %6.3f %6.3f dmean %6.3f %6.3f  vol %8.2f "
      "%8.2f %+6.2f%%  seat %6.2f %6.2f  plate %6.2f %6.2f  rim %7.3f %7.3f %7.3f %7.3f area %7.2f %7.2f\n",
      GetParam(), reaming.plan.reamer.substr(0, 30).c_str(), said("version_achieved_deg"), truth.version_deg,
      said("entry_error_mm"), truth.entry_error_mm, said("depth_max_mm"), truth.depth_max_mm,
      said("depth_mean_mm"), truth.depth_mean_mm, said("removed_volume_mm3"), truth.volume_mm3,
      100.0 * (said("removed_volume_mm3") / truth.volume_mm3 - 1.0), said("seating_percent"),
      truth.seating_percent, said("plate_preserved_percent"), truth.plate_percent, said("version_rim_deg"),
      truth.rim_version_deg, said("inclination_rim_deg"), truth.rim_inclination_deg,
      said("footprint_area_mm2"), truth.footprint_mm2);
  EXPECT_NEAR(said("version_rim_deg"), truth.rim_version_deg, 0.5);
  EXPECT_NEAR(said("inclination_rim_deg"), truth.rim_inclination_deg, 0.5);
}

INSTANTIATE_TEST_SUITE_P(Seeds, ScoreTruth,
                         testing::Range(unsigned{REAM_FIRST_SEED}, unsigned{REAM_LAST_SEED} + 1));

}  // namespace
}  // namespace ream::test
