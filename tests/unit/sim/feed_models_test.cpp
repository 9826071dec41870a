#include <gtest/gtest.h>

#include <cmath>

#include "force/coefficients.hpp"
#include "score/metrics.hpp"
#include "sim/cutting_surface.hpp"
#include "support/small_run.hpp"

namespace ream::test {
namespace {

constexpr double feed_surface_mm = 9.0;
/// Depth at which the whole cutting surface of "sphere 8,5" (1.76 mm high) is in the bone.
constexpr double seated_mm = 1.9;

struct Specimen {
  double density_g_cc, slope, intercept;
  double law_mm_s(double thrust_n) const { return thrust_n / 52.0 * (slope * density_g_cc + intercept); }
};
constexpr Specimen cortical_specimen{1.5, -0.05, 0.11}, cancellous{0.55, -0.34, 0.42};

/// A slab that has the shape of the seated tool at the plan's entry.
voxel::BoneModel seat(const Specimen& specimen, const shell::ToolProfile& profile) {
  voxel::BoneModel bone = slab({56, 56, 64}, 0.2, feed_surface_mm, specimen.density_g_cc);
  const Vec3 entry_mm = slab_plan(bone, feed_surface_mm).entry_mm;
  for (int w = 0; w < 64; ++w)
    for (int v = 0; v < 56; ++v)
      for (int u = 0; u < 56; ++u) {
        const Vec3 at = (Vec3(u, v, w) + Vec3::Constant(0.5)) * 0.2 - entry_mm;
        const double distance =
            shell::swept_distance_mm(profile, std::hypot(at.x(), at.y()), -at.z() - seated_mm);
        const double left = std::clamp(127.5 + 255.0 * distance / 0.2, 0.0, 255.0);
        uint8_t& coverage = bone.coverage[bone.grid.index(u, v, w)];
        coverage = std::min(coverage, static_cast<uint8_t>(left));
      }
  return bone;
}

struct Steady {
  double feed_mm_s = 0.0;
  double ripple = 0.0;  ///< span of thrust over its mean
};

/// The second second of pressing a tool in full contact.
Steady full_contact(const force::FeedSettings& feed, const Specimen& specimen, double thrust_n) {
  const shell::ToolProfile profile = shell::make_tool("sphere 8,5").profile;
  voxel::BoneModel bone = seat(specimen, profile);
  const case_::Plan plan = slab_plan(bone, feed_surface_mm);
  device::Script script = steady_push(thrust_n, 2.0);
  script.hand.start_mm = Vec3(0, 0, seated_mm);
  SmallRun run(std::move(bone), plan, "sphere 8,5", script);
  run.model.feed = force::make_feed_model(feed, sim::cutting_lip(profile));
  const auto reports = run.run();
  double least = 1e9, most = 0.0, sum = 0.0;
  for (size_t i = 1000; i < reports.size(); ++i) {
    least = std::min(least, reports[i].thrust_n);
    most = std::max(most, reports[i].thrust_n);
    sum += reports[i].thrust_n;
  }
  const auto &a = reports[1000], &b = reports.back();
  const double advance_mm = (b.world_from_tool.translation_mm - a.world_from_tool.translation_mm).norm();
  return {advance_mm / (1e-3 * static_cast<double>(b.tick - a.tick)),
          (most - least) * static_cast<double>(reports.size() - 1000) / sum};
}

class FeedModels : public testing::TestWithParam<force::FeedKind> {
 protected:
  static force::FeedSettings settings() {
    force::FeedSettings s;
    s.kind = GetParam();
    return s;
  }
};

TEST_P(FeedModels, FeedByTheLawInFullContact) {
  for (const Specimen& specimen : {cortical_specimen, cancellous})
    for (const double thrust_n : {20.0, 35.0, 52.0, 78.0}) {
      const double law = specimen.law_mm_s(thrust_n);
      const Steady steady = full_contact(settings(), specimen, thrust_n);
      EXPECT_NEAR(steady.feed_mm_s, law, 0.02 * law)
          << specimen.density_g_cc << " g/cc, " << thrust_n << " N";
      EXPECT_LT(steady.ripple, 0.02) << specimen.density_g_cc << " g/cc, " << thrust_n << " N";
    }
}

TEST_P(FeedModels, FeedAsTheSpindleTurnsAndTheSpecimenYields) {
  force::FeedSettings fast = settings();
  fast.spindle_rad_s = 2.5 * force::reference_spindle_rad_s;
  fast.specimen_factor = 0.712;
  const double expected = 2.5 * 0.712 * cortical_specimen.law_mm_s(52.0);
  EXPECT_NEAR(full_contact(fast, cortical_specimen, 52.0).feed_mm_s, expected, 0.02 * expected);
}

TEST(BentFeedLaw, SettlesOnItsOwnCurve) {
  // Specific cutting force falls as chips thicken: feed then grows with thrust^(1 / (1 - 0.4)), a little less
  // where the feed's slope adds to thrust.
  force::FeedSettings bent;
  bent.kind = force::FeedKind::oblique;
  bent.cutting.depth_exponent = -0.4;
  for (const double thrust_n : {26.0, 52.0, 78.0}) {
    const double expected = cancellous.law_mm_s(52.0) * std::pow(thrust_n / 52.0, 1.0 / 0.6);
    const Steady steady = full_contact(bent, cancellous, thrust_n);
    EXPECT_NEAR(steady.feed_mm_s, expected, 0.05 * expected) << thrust_n << " N";
    EXPECT_LT(steady.ripple, 0.02) << thrust_n << " N";
  }
}

INSTANTIATE_TEST_SUITE_P(Models, FeedModels,
                         testing::Values(force::FeedKind::empirical, force::FeedKind::oblique),
                         [](const auto& kind) { return std::string(force::to_text(kind.param)); });

TEST(ApparentStiffness, IsMeasuredBetweenTheForceModelsThrusts) {
  EXPECT_EQ(score::stiffness_from_n, force::start_threshold_n);
  EXPECT_EQ(score::stiffness_to_n, 0.9 * force::reference_thrust_n);
}

}  // namespace
}  // namespace ream::test
