#include <gtest/gtest.h>

#include "force/coefficients.hpp"
#include "score/metrics.hpp"
#include "support/small_run.hpp"

namespace ream::test {
namespace {

constexpr double surface_mm = 9.0;
/// Depth at which the whole cutting surface of "sphere 8,5" (1.76 mm high) is in the bone.
constexpr double seated_mm = 1.9;

struct Specimen {
  double density_g_cc, slope, intercept;
  double law_mm_s(double thrust_n) const { return thrust_n / 52.0 * (slope * density_g_cc + intercept); }
};
constexpr Specimen cortical{1.5, -0.05, 0.11}, cancellous{0.55, -0.34, 0.42};

/// Feed in full contact: the tool is put down in bone that has its shape, and pressed.
double full_contact_feed_mm_s(force::FeedKind kind, const Specimen& specimen, double thrust_n,
                              const device::Script& settings = {}) {
  voxel::BoneModel bone = slab({56, 56, 64}, 0.2, surface_mm, specimen.density_g_cc);
  const case_::Plan plan = slab_plan(bone, surface_mm);
  const shell::ToolProfile profile = shell::make_tool("sphere 8,5").profile;
  for (int w = 0; w < 64; ++w)
    for (int v = 0; v < 56; ++v)
      for (int u = 0; u < 56; ++u) {
        const Vec3 at = (Vec3(u, v, w) + Vec3::Constant(0.5)) * 0.2 - plan.entry_mm;
        const double distance =
            shell::swept_distance_mm(profile, std::hypot(at.x(), at.y()), -at.z() - seated_mm);
        const double left = std::clamp(127.5 + 255.0 * distance / 0.2, 0.0, 255.0);
        uint8_t& coverage = bone.coverage[bone.grid.index(u, v, w)];
        coverage = std::min(coverage, static_cast<uint8_t>(left));
      }
  device::Script script = steady_push(thrust_n, 2.0);
  script.spindle_rpm = settings.spindle_rpm;
  script.specimen_factor = settings.specimen_factor;
  script.hand.start_mm = Vec3(0, 0, seated_mm);
  SmallRun run(std::move(bone), plan, "sphere 8,5", script, "cpu", sim::RemovalLaw::profile, kind);
  const auto reports = run.run();
  const auto &a = reports[1000], &b = reports.back();
  return (b.world_from_tool.translation_mm - a.world_from_tool.translation_mm).norm() /
         (1e-3 * static_cast<double>(b.tick - a.tick));
}

class FeedModels : public testing::TestWithParam<force::FeedKind> {};

TEST_P(FeedModels, FeedByTheLawInFullContact) {
  for (const Specimen& specimen : {cortical, cancellous})
    for (const double thrust_n : {20.0, 35.0, 52.0, 78.0}) {
      const double law = specimen.law_mm_s(thrust_n);
      EXPECT_NEAR(full_contact_feed_mm_s(GetParam(), specimen, thrust_n), law, 0.02 * law)
          << specimen.density_g_cc << " g/cc, " << thrust_n << " N";
    }
}

TEST_P(FeedModels, FeedAsTheSpindleTurnsAndTheSpecimenYields) {
  device::Script script;
  script.spindle_rpm = 2.5 * 156.0;
  script.specimen_factor = 0.712;
  const double expected = 2.5 * 0.712 * cortical.law_mm_s(52.0);
  EXPECT_NEAR(full_contact_feed_mm_s(GetParam(), cortical, 52.0, script), expected, 0.02 * expected);
}

INSTANTIATE_TEST_SUITE_P(Models, FeedModels,
                         testing::Values(force::FeedKind::empirical, force::FeedKind::oblique,
                                         force::FeedKind::scraping),
                         [](const auto& kind) { return std::string(force::to_text(kind.param)); });

TEST(ScrapingInSmallContact, FeedsFasterThanTheLaw) {
  // First contact of a ball with a flat: the footprint is far smaller than the planned seating's.
  voxel::BoneModel bone = slab({56, 56, 64}, 0.2, surface_mm, cortical.density_g_cc);
  const case_::Plan plan = slab_plan(bone, surface_mm);
  SmallRun run(std::move(bone), plan, "sphere 8,5", steady_push(52.0, 2.0), "cpu", sim::RemovalLaw::profile,
               force::FeedKind::scraping);
  const auto reports = run.run();
  const double advance_mm =
      (reports.back().world_from_tool.translation_mm - reports[1000].world_from_tool.translation_mm).norm();
  EXPECT_GT(advance_mm, 1.5 * cortical.law_mm_s(52.0));
}

TEST(ApparentStiffness, IsMeasuredBetweenTheForceModelsThrusts) {
  EXPECT_EQ(score::stiffness_from_n, force::start_threshold_n);
  EXPECT_EQ(score::stiffness_to_n, 0.9 * force::reference_thrust_n);
}

}  // namespace
}  // namespace ream::test
