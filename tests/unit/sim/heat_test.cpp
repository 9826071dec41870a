#include <gtest/gtest.h>

#include "support/small_run.hpp"

namespace ream::test {
namespace {

/// Ten seconds of a reamer of 12 mm on a slab of dense bone.
std::vector<record::TickReport> reamed(bool irrigated, double saline_film_w_m2_k = 300.0) {
  constexpr double slab_top_mm = 9.0;
  voxel::BoneModel bone = slab({96, 96, 96}, 0.15, slab_top_mm, 1.5);
  const case_::Plan plan = slab_plan(bone, slab_top_mm);
  device::Script script = steady_push(20.0, 10.0);
  script.buttons = {{0.0, true, false, {255, false, irrigated}}};
  sim::Settings settings = SmallRun::settings(script, "cpu", sim::RemovalLaw::profile, force::FeedKind::edge);
  settings.heat.saline_film_w_m2_k = saline_film_w_m2_k;
  SmallRun run(std::move(bone), plan, "ellipse 6,2", script, settings);
  return run.run();
}

TEST(HeatOfReaming, DryCutsWarmTheBoneAndIrrigatedOnesLess) {
  const auto dry = reamed(false), wet = reamed(true);
  ASSERT_EQ(dry.size(), wet.size());
  double energy_j = 0.0, hottest_c = 0.0;
  for (const auto& r : dry) {
    energy_j += r.spindle_torque_n_mm * 1e-3 * rad_s_from_rpm(156.0) * 1e-3;
    if (energy_j == 0.0) {
      EXPECT_EQ(r.surface_temperature_c, 35.0) << r.tick;
    }
    hottest_c = std::max(hottest_c, r.surface_temperature_c);
  }
  EXPECT_GT(energy_j, 1.0);
  EXPECT_GT(hottest_c, 45.0);
  EXPECT_LT(hottest_c, 150.0);
  EXPECT_LT(wet.back().surface_temperature_c, dry.back().surface_temperature_c - 3.0);
  std::cout << hottest_c << " C dry, " << wet.back().surface_temperature_c << " C irrigated, " << energy_j
            << " J\n";
}

TEST(HeatOfReaming, DecidesNothing) {
  const auto plain = reamed(true), cold = reamed(true, 5000.0);
  ASSERT_EQ(plain.size(), cold.size());
  EXPECT_NE(plain.back().surface_temperature_c, cold.back().surface_temperature_c);
  for (size_t i = 0; i < plain.size(); ++i) {
    ASSERT_EQ(plain[i].session_hash, cold[i].session_hash) << i;
    ASSERT_EQ(plain[i].hand_force_n, cold[i].hand_force_n) << i;
  }
}

}  // namespace
}  // namespace ream::test
