#include "force/feed_model.hpp"

#include <gtest/gtest.h>

namespace ream::force {
namespace {

TEST(FeedLaw, ReproducesTheThesisEquations) {
  EXPECT_NEAR(empirical_feed_mm_s(1, 1.50), 0.035, 1e-12);
  EXPECT_NEAR(empirical_feed_mm_s(0, 0.55), 0.233, 1e-12);
  // The two laws cross at 1.069 g/cc.
  EXPECT_NEAR(empirical_feed_mm_s(0, 1.069), empirical_feed_mm_s(1, 1.069), 1e-3);
}

TEST(FeedLaw, WithItsFactorIsTheSpecimensFeed) {
  // Table 5.1: density, feed; and the specimen factors that follow. Without them the largest deviation is
  // 29 %.
  const double cortical[][3] = {{1.52, .037, 1.088}, {1.54, .035, 1.061}, {1.61, .021, .712},
                                {1.40, .038, .950},  {1.58, .026, .839},  {1.30, .039, .867}};
  const double cancellous[][3] = {{.55, .25, 1.073}, {.41, .28, .998},  {.72, .16, .913},
                                  {.45, .26, .974},  {.62, .23, 1.099}, {.48, .25, .974}};
  for (const auto& s : cortical) {
    EXPECT_NEAR(s[1] / empirical_feed_mm_s(1, s[0]), 1.0, 0.30);
    EXPECT_NEAR(empirical_feed_mm_s(1, s[0], s[2]), s[1], 1e-3 * s[1]);
  }
  for (const auto& s : cancellous) {
    EXPECT_NEAR(s[1] / empirical_feed_mm_s(0, s[0]), 1.0, 0.11);
    EXPECT_NEAR(empirical_feed_mm_s(0, s[0], s[2]), s[1], 1e-3 * s[1]);
  }
}

TEST(FeedLaw, NeverTurnsNegative) {
  for (double d = 0.0; d <= 2.5; d += 0.01)
    for (int k = 0; k < 3; ++k)
      for (const double factor : {0.1, 1.0, 10.0})
        EXPECT_GE(empirical_feed_mm_s(k, d, factor), min_feed_mm_s);
}

TEST(FeedLaw, MixesClassesByShare) {
  EngagedBone pure;
  pure.share = {0, 1, 0};
  pure.density_g_cc = {0, 1.68, 0};
  // The thesis' damping of 2000 N s/mm.
  EXPECT_NEAR(lawful_resistance_n_s_mm(pure, {}), 52.0 / 0.026, 1e-6);
  EngagedBone mixed = pure;
  mixed.share = {0.5, 0.5, 0};
  mixed.density_g_cc = {0.6, 1.68, 0};
  EXPECT_NEAR(lawful_resistance_n_s_mm(mixed, {}), 0.5 * 52.0 / 0.026 + 0.5 * 52.0 / 0.216, 1e-6);
}

TEST(FeedLaw, KeepsTheFeedOfARevolution) {
  const double feed_mm_s = 0.039;
  EXPECT_NEAR(feed_a_revolution_mm(feed_mm_s, reference_spindle_rad_s), feed_mm_s / 2.6, 1e-15);
  EngagedBone bone;
  bone.share = {0, 1, 0};
  bone.density_g_cc = {0, 1.42, 0};
  FeedSettings fast;
  fast.spindle_rad_s = 2.5 * reference_spindle_rad_s;
  const double feed_fast_mm_s = 52.0 / lawful_resistance_n_s_mm(bone, fast);
  EXPECT_NEAR(feed_fast_mm_s, 2.5 * feed_mm_s, 1e-12);
  EXPECT_NEAR(feed_a_revolution_mm(feed_fast_mm_s, fast.spindle_rad_s), feed_mm_s / 2.6, 1e-14);
}

}  // namespace
}  // namespace ream::force
