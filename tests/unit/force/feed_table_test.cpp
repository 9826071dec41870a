#include "force/feed_model.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/expect_error.hpp"
#include "unit/force/thesis_lip.hpp"

namespace ream::force {
namespace {

using test::thesis_lip;

TEST(FeedTable, IsLinearBetweenItsRowsAndBeyond) {
  const FeedTable table({0.0, 1.0, 3.0}, {0.0, 2.0, 10.0}, {0.0, 5.0, 6.0});
  for (const double x : {0.0, 0.25, 1.0}) EXPECT_DOUBLE_EQ(table.thrust_mm2_at(x), 2.0 * x);
  EXPECT_DOUBLE_EQ(table.thrust_mm2_at(2.0), 6.0);
  EXPECT_DOUBLE_EQ(table.thrust_mm2_at(5.0), 18.0);
  EXPECT_DOUBLE_EQ(table.torque_mm3_at(2.0), 5.5);
  for (const double x : {0.0, 0.3, 1.0, 1.7, 3.0, 40.0})
    EXPECT_NEAR(table.feed_mm_at(table.thrust_mm2_at(x)), x, 1e-12 * (1.0 + x));
}

TEST(FeedTable, IsTheLipAtAnyFeed) {
  const Lip lip = thesis_lip(200);
  for (const double depth_exponent : {0.0, -0.5, 0.4}) {
    const CuttingCoefficients coefficients{0.5, depth_exponent, 0.1, 0.0, 0.0};
    const FeedTable table = make_feed_table(lip, coefficients, 20.0);
    for (double feed_mm = 1.5e-4; feed_mm < 4.0; feed_mm *= 1.7) {
      const LipLoad load = whole_load(lip_loads(lip, coefficients, {feed_mm, 20.0}));
      EXPECT_NEAR(table.thrust_mm2_at(feed_mm), load.thrust_n, 5e-4 * load.thrust_n) << feed_mm;
      EXPECT_NEAR(table.torque_mm3_at(feed_mm), load.torque_n_mm, 5e-4 * load.torque_n_mm) << feed_mm;
    }
  }
}

TEST(FeedTable, HashKnowsEveryInput) {
  const Lip lip = thesis_lip(50);
  const auto hash = [](const Lip& l, const CuttingCoefficients& c, double rad_s) {
    return make_feed_table(l, c, rad_s).hash();
  };
  const CuttingCoefficients sped{0.5, 0.0, 0.1, 0.0, 0.0};
  EXPECT_EQ(hash(lip, {}, 16.0), hash(lip, {}, 16.0));
  EXPECT_NE(hash(lip, {}, 16.0), hash(thesis_lip(51), {}, 16.0));
  EXPECT_NE(hash(lip, {}, 16.0), hash(lip, {0.6}, 16.0));
  EXPECT_NE(hash(lip, sped, 16.0), hash(lip, sped, 17.0));
  // Forces that do not know the speed have one table for all speeds.
  EXPECT_EQ(hash(lip, {}, 16.0), hash(lip, {}, 17.0));
}

TEST(FeedTable, RefusesLipsThatPullThemselvesIn) {
  test::expect_error(ErrorKind::invalid_input, "no more thrust",
                     [] { make_feed_table(thesis_lip(50), {0.02}, 16.0); });
  test::expect_error(ErrorKind::invalid_input, "no more thrust", [] { make_feed_table({}, {}, 16.0); });
}

}  // namespace
}  // namespace ream::force
