#include "bench/validate/published.hpp"

#include <gtest/gtest.h>

#include <array>

#include "statistics/regression.hpp"

namespace ream::bench {
namespace {

TEST(PublishedBone, TheThesisTableGivesThePublishedCorrelations) {
  for (const PublishedBone* bone : {&published_cortical, &published_cancellous}) {
    std::array<double, 6> density, feed;
    for (size_t i = 0; i < 6; ++i) {
      density[i] = bone->specimens[i].density_g_cc;
      feed[i] = bone->specimens[i].feed_mm_s;
    }
    const statistics::Regression r = statistics::regression(density, feed);
    EXPECT_NEAR(r.rho, bone->rho, 5e-5) << bone->name;
    EXPECT_NEAR(r.r_squared, bone->r_squared, 5e-4) << bone->name;
    EXPECT_NEAR(r.p, bone->p, 5e-5) << bone->name;
    EXPECT_NEAR(r.slope, bone->law.slope_mm_s_per_g_cc, 0.005) << bone->name;
    EXPECT_NEAR(r.intercept, bone->law.intercept_mm_s, 0.005) << bone->name;
  }
}

TEST(PublishedBone, SpecimenFactorsAreThoseOfTheTable) {
  const std::array cortical{1.088, 1.061, 0.712, 0.950, 0.839, 0.867};
  const std::array cancellous{1.073, 0.998, 0.913, 0.974, 1.099, 0.974};
  for (size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(specimen_factor(published_cortical, published_cortical.specimens[i]), cortical[i], 6e-4);
    EXPECT_NEAR(specimen_factor(published_cancellous, published_cancellous.specimens[i]), cancellous[i],
                6e-4);
  }
}

}  // namespace
}  // namespace ream::bench
