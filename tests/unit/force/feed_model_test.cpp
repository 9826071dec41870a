#include "force/feed_model.hpp"

#include <gtest/gtest.h>

#include "force/coefficients.hpp"

namespace ream::force {
namespace {

TEST(EmpiricalFeed, ReproducesTheThesisEquations) {
  EXPECT_NEAR(empirical_feed_mm_s(1, 1.50), 0.035, 1e-12);
  EXPECT_NEAR(empirical_feed_mm_s(0, 0.55), 0.233, 1e-12);
  // The two laws cross at 1.069 g/cc (science.md, finding 3).
  EXPECT_NEAR(empirical_feed_mm_s(0, 1.069), empirical_feed_mm_s(1, 1.069), 1e-3);
}

TEST(EmpiricalFeed, StaysWithinTheScatterOfTheSpecimens) {
  // Table 5.1: density, feed; the largest deviation of a specimen from the law is 29 %.
  const double cortical[][2] = {{1.52, .037}, {1.54, .035}, {1.61, .021},
                                {1.40, .038}, {1.58, .026}, {1.30, .039}};
  const double cancellous[][2] = {{.55, .25}, {.41, .28}, {.72, .16}, {.45, .26}, {.62, .23}, {.48, .25}};
  for (const auto& s : cortical) EXPECT_NEAR(s[1] / empirical_feed_mm_s(1, s[0]), 1.0, 0.30);
  for (const auto& s : cancellous) EXPECT_NEAR(s[1] / empirical_feed_mm_s(0, s[0]), 1.0, 0.11);
}

TEST(EmpiricalFeed, NeverTurnsNegative) {
  for (double d = 0.0; d <= 2.5; d += 0.01)
    for (int k = 0; k < 3; ++k) EXPECT_GE(empirical_feed_mm_s(k, d), slowest_feed_mm_s);
}

TEST(EmpiricalFeedModel, MixesClassesByShare) {
  const auto model = make_empirical_feed_model();
  EngagedBone pure;
  pure.share = {0, 1, 0};
  pure.density_g_cc = {0, 1.68, 0};
  EXPECT_NEAR(model->load(pure, 0.0).resistance_n_s_mm, 52.0 / 0.026,
              1e-6);  // the thesis' damping of 2000 N s/mm
  EngagedBone mixed = pure;
  mixed.share = {0.5, 0.5, 0};
  mixed.density_g_cc = {0.6, 1.68, 0};
  EXPECT_NEAR(model->load(mixed, 0.0).resistance_n_s_mm, 0.5 * 52.0 / 0.026 + 0.5 * 52.0 / 0.216, 1e-6);
}

}  // namespace
}  // namespace ream::force
