#include <gtest/gtest.h>

#include <algorithm>

#include <cmath>

#include "sim/hand_output.hpp"
#include "support/small_run.hpp"

namespace ream::test {
namespace {

/// A handle that presses 4 mm into the bone over a second whatever it feels, so that only the simulation
/// can make runs differ. The first and last tenth are in the air, with a rest in the middle.
device::Script press_and_leave() {
  device::Script script;
  script.kind = device::ScriptKind::poses;
  script.duration_s = 1.0;
  script.stiffness_n_mm = 50.0;
  script.poses = {
      {0.0, Vec3(0, 0, -0.5)}, {0.1, Vec3(0, 0, -0.1)}, {0.9, Vec3(0, 0, 4.0)}, {0.95, Vec3(0, 0, -3)}};
  script.buttons = {{0.0, true, false}, {0.5, true, true}, {0.55, true, false}};
  return script;
}

sim::Settings settings(force::VibrationSource source, uint64_t seed = 1) {
  sim::Settings s = SmallRun::settings(press_and_leave(), "cpu");
  s.vibration.source = source;
  s.random_seed = seed;
  return s;
}

struct VibratingRun {
  explicit VibratingRun(const sim::Settings& s) : run(make(s)), reports(run.run()) {}

  static SmallRun make(const sim::Settings& s) {
    voxel::BoneModel bone = slab({64, 64, 64}, 0.2, 9.0, 0.5);
    const case_::Plan plan = slab_plan(bone, 9.0);
    return SmallRun(std::move(bone), plan, "sphere 8,4", press_and_leave(), s);
  }

  SmallRun run;
  std::vector<record::TickReport> reports;
};

double rms_g(const std::vector<record::TickReport>& reports, size_t from, size_t to) {
  double sum = 0.0;
  for (size_t i = from; i < to; ++i) sum += reports[i].vibration_g * reports[i].vibration_g;
  return std::sqrt(sum / static_cast<double>(to - from));
}

TEST(Vibration, DecidesNothing) {
  const VibratingRun off(settings(force::VibrationSource::off));
  ASSERT_GT(off.reports.back().session_hash, 0u);
  for (const uint64_t seed : {1, 2}) {
    const VibratingRun on(settings(force::VibrationSource::synthesized, seed));
    ASSERT_EQ(on.reports.size(), off.reports.size());
    EXPECT_EQ(on.reports.back().session_hash, off.reports.back().session_hash);
    EXPECT_EQ(on.run.bone.coverage, off.run.bone.coverage);
    int64_t removed = 0;
    for (const record::TickReport& report : on.reports) removed += report.coverage_removed[0];
    EXPECT_GT(removed, 10000);
  }
}

TEST(Vibration, OffIsStill) {
  for (const record::TickReport& report : VibratingRun(settings(force::VibrationSource::off)).reports)
    EXPECT_EQ(report.vibration_g, 0.0);
}

TEST(Vibration, FollowsWhatTheToolDoes) {
  const auto reports = VibratingRun(settings(force::VibrationSource::synthesized)).reports;
  ASSERT_EQ(reports.size(), 1000u);
  ASSERT_TRUE(reports[400].cutting);
  const size_t touched = static_cast<size_t>(
      std::find_if(reports.begin(), reports.end(), [](const auto& r) { return r.cutting; }) -
      reports.begin());
  ASSERT_GT(touched, 40u);
  // So few ticks may hold one of the idle drill's blows, or none.
  EXPECT_GT(rms_g(reports, 20, touched), 0.005) << "idle spin before contact";
  EXPECT_LT(rms_g(reports, 20, touched), 0.15) << "idle spin before contact";
  EXPECT_GT(rms_g(reports, 250, 500), 0.15) << "cancellous bone";
  EXPECT_EQ(rms_g(reports, 500, 550), 0.0) << "at rest";
  EXPECT_LT(rms_g(reports, 990, 1000), 0.15) << "back in the air";
}

TEST(Vibration, SameSeedSameTicks) {
  const auto of = [](uint64_t seed) {
    std::vector<double> g;
    for (const record::TickReport& report :
         VibratingRun(settings(force::VibrationSource::synthesized, seed)).reports)
      g.push_back(report.vibration_g);
    return g;
  };
  EXPECT_EQ(of(5), of(5));
  EXPECT_NE(of(5), of(6));
}

/// g rms of five seconds of pressing on even bone, after half a second, over what this seed's specimen has.
double pressed_g_rms(double force_n, double density_g_cc, uint64_t seed) {
  device::Script script = steady_push(force_n, 5.0);
  sim::Settings s = SmallRun::settings(script, "cpu", sim::RemovalLaw::profile, force::FeedKind::edge);
  s.vibration.source = force::VibrationSource::synthesized;
  s.random_seed = seed;
  voxel::BoneModel bone = slab({64, 64, 64}, 0.6, 12.0, density_g_cc);
  const case_::Plan plan = slab_plan(bone, 12.0);
  SmallRun run(std::move(bone), plan, "thesis-appendix-a", script, s);
  const auto reports = run.run();
  const size_t kind = density_g_cc < 1.0 ? 0 : 1;
  return rms_g(reports, 500, reports.size()) / run.model.vibration_of_specimen[kind];
}

TEST(Vibration, RisesWithThrustAndNeedsNoBoneToHum) {
  double before_g = 0.05;
  for (const double force_n : {2.0, 10.0, 52.0}) {
    const double g = pressed_g_rms(force_n, 0.5, 3);
    EXPECT_GT(g, 1.03 * before_g) << force_n;
    before_g = g;
  }
}

TEST(Vibration, SpecimensSpreadAsPublished) {
  // Thesis table 5.2: 0.40 +- 0.07 g in cancellous and 0.30 +- 0.09 g in cortical bone.
  constexpr struct {
    force::VibrationKind kind;
    double share;
  } published[] = {{force::VibrationKind::cancellous, 0.07 / 0.40},
                   {force::VibrationKind::cortical, 0.09 / 0.30}};
  for (const auto& [kind, share] : published) {
    double sum = 0.0, squares = 0.0;
    constexpr int seeds = 2000;
    for (int seed = 0; seed < seeds; ++seed) {
      const double factor = force::specimen_vibration(kind, static_cast<uint64_t>(seed));
      EXPECT_GT(factor, 0.0);
      sum += factor;
      squares += factor * factor;
    }
    const double mean = sum / seeds;
    EXPECT_NEAR(mean, 1.0, 4.0 * share / std::sqrt(seeds));
    EXPECT_NEAR(std::sqrt(squares / seeds - mean * mean), share, 0.07 * share);
  }
  EXPECT_EQ(force::specimen_vibration(force::VibrationKind::cartilage, 5), 1.0) << "nobody published any";
}

}  // namespace
}  // namespace ream::test
