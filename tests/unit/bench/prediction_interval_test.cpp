#include "bench/validate/prediction_interval.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace ream::bench {
namespace {

TEST(PredictionInterval, IsThatOfTheTextbook) {
  // Five points about y = x: residuals 0, 0.1, -0.2, 0.1, 0 (sums 0 and 0 with x), so s^2 = 0.06 / 3.
  const Prediction at =
      prediction_95(std::vector<double>{1, 2, 3, 4, 5}, std::vector<double>{1.0, 2.1, 2.8, 4.1, 5.0}, 5.0);
  EXPECT_NEAR(at.middle, 5.0, 1e-12);
  const double reach = 3.182446 * std::sqrt(0.02 * (1.0 + 0.2 + 0.4));
  EXPECT_NEAR(at.high - at.middle, reach, 1e-6);
  EXPECT_NEAR(at.middle - at.low, reach, 1e-6);
}

}  // namespace
}  // namespace ream::bench
