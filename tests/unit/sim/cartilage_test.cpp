#include <gtest/gtest.h>

#include <cmath>

#include "force/coefficients.hpp"
#include "force/vibration/vibration_tracks.hpp"
#include "support/small_run.hpp"

namespace ream::test {
namespace {

constexpr double surface_mm = 9.0, cartilage_mm = 2.0, press_force_n = 40.0, bone_g_cc = 1.5;
constexpr auto cartilage = static_cast<size_t>(voxel::BoneClass::cartilage),
               cortical = static_cast<size_t>(voxel::BoneClass::cortical);

/// Compact bone under 2 mm of cartilage, pressed with a steady force.
std::vector<record::TickReport> reamed(double duration_s, force::VibrationSource vibration) {
  voxel::BoneModel bone = slab({96, 96, 96}, 0.15, surface_mm, bone_g_cc);
  for (int w = 0; w < bone.grid.dims.z(); ++w)
    for (int v = 0; v < bone.grid.dims.y(); ++v)
      for (int u = 0; u < bone.grid.dims.x(); ++u)
        if (bone.grid.centre_mm({u, v, w}).z() > surface_mm - cartilage_mm)
          bone.density.writable()[bone.grid.index(u, v, w)] = voxel::cartilage_code;
  const case_::Plan plan = slab_plan(bone, surface_mm);
  const device::Script script = steady_push(press_force_n, duration_s);
  sim::Settings settings = SmallRun::settings(script, "cpu");
  settings.vibration.source = vibration;
  return SmallRun(std::move(bone), plan, "sphere 8,5", script, settings).run();
}

double depth_mm(const record::TickReport& report) {
  return surface_mm - report.world_from_tool.translation_mm.z();
}

TEST(Cartilage, IsReamedAtItsOwnFeedAndThenBoneAtIts) {
  const auto reports = reamed(9.0, force::VibrationSource::off);
  ASSERT_EQ(reports.size(), 9000u);
  const double feed_mm_s = press_force_n / force::reference_thrust_n * force::cartilage_feed_mm_s;
  const auto &early = reports[1500], &late = reports[4500];
  EXPECT_NEAR((depth_mm(late) - depth_mm(early)) / 3.0, feed_mm_s, 0.02 * feed_mm_s);
  int64_t removed = 0;
  for (size_t i = 1500; i < 4500; ++i) {
    ASSERT_NEAR(reports[i].share[cartilage], 1.0, 1e-12) << i;
    ASSERT_EQ(reports[i].coverage_removed[cortical], 0) << i;
    removed += reports[i].coverage_removed[cartilage];
  }
  EXPECT_GT(removed, 0);
  // Past the layer the bone takes over, and it yields less.
  EXPECT_GT(depth_mm(reports.back()), cartilage_mm);
  EXPECT_GT(reports.back().share[cortical], 0.05);
  const double last_mm_s = depth_mm(reports.back()) - depth_mm(reports[reports.size() - 1001]);
  EXPECT_LT(last_mm_s, 0.8 * feed_mm_s);
}

TEST(Cartilage, VibratesAsCartilageDoes) {
  const auto reports = reamed(4.5, force::VibrationSource::synthesized);
  const double level = force::vibration_levels[static_cast<size_t>(force::VibrationKind::cartilage)].g_rms;
  const double idle_g = force::vibration_levels[static_cast<size_t>(force::VibrationKind::idle)].g_rms;
  double sum = 0.0, expected = 0.0;
  for (size_t i = 1500; i < 4500; ++i) {
    sum += reports[i].vibration_g * reports[i].vibration_g;
    // Five lips of a ball of 8 mm, as far as they are in: 5 times the integral of sqrt(1 - r^2 / 64).
    const double rim =
        std::sqrt(16.0 * depth_mm(reports[i]) - depth_mm(reports[i]) * depth_mm(reports[i])) / 8.0;
    const double edge_mm = 20.0 * (rim * std::sqrt(1.0 - rim * rim) + std::asin(rim));
    const double cut_g = level * press_force_n / 52.0 * std::sqrt(70.5 / edge_mm);
    expected += idle_g * idle_g + cut_g * cut_g;
  }
  EXPECT_NEAR(std::sqrt(sum / expected), 1.0, 0.1);
  EXPECT_LT(level, 0.5 * force::vibration_levels[static_cast<size_t>(force::VibrationKind::cortical)].g_rms);
}

}  // namespace
}  // namespace ream::test
