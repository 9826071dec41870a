#include "geometry/ordered_product.hpp"

#include <gtest/gtest.h>

#include <random>

#include "support/seed.hpp"

namespace ream::test {
namespace {

/// Nine numbers and three, of very different sizes, so that another order gives other bits.
struct Drawn {
  explicit Drawn(std::mt19937& random) {
    const auto number = [&] {
      const double sign = random() % 2 == 0 ? 1.0 : -1.0;
      return sign * std::ldexp(1.0 + static_cast<double>(random()) / 4294967296.0,
                               static_cast<int>(random() % 12) - 6);
    };
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) pose.rotation(i, j) = number();
      pose.translation_mm[i] = number();
      v[i] = number();
    }
  }
  Pose pose;
  Vec3 v;
};

#if defined(__x86_64__) && !defined(__AVX__)
/// Recordings were made with Eigen's order.
TEST(OrderedProduct, IsEigensOnThisProcessor) {
  std::mt19937 random(seed());
  for (int i = 0; i < 20'000; ++i) {
    const Drawn d(random);
    ASSERT_EQ(ordered_product(d.pose.rotation, d.v), Vec3(d.pose.rotation * d.v));
    ASSERT_EQ(ordered_point(d.pose, d.v), d.pose.point(d.v));
    ASSERT_EQ(ordered_norm(d.v), d.v.norm());
  }
}
#endif

/// Whatever adds them: by volatile numbers, which no compiler puts into another order.
TEST(OrderedProduct, AddsInItsOrder) {
  std::mt19937 random(seed());
  for (int i = 0; i < 20'000; ++i) {
    const Drawn d(random);
    volatile double term[3][3], sum[3];
    for (int row = 0; row < 3; ++row)
      for (int k = 0; k < 3; ++k) term[row][k] = d.pose.rotation(row, k) * d.v[k];
    for (int row = 0; row < 2; ++row) {
      sum[row] = term[row][0] + term[row][1];
      sum[row] = sum[row] + term[row][2];
    }
    sum[2] = term[2][1] + term[2][2];
    sum[2] = term[2][0] + sum[2];
    ASSERT_EQ(ordered_product(d.pose.rotation, d.v), Vec3(double(sum[0]), double(sum[1]), double(sum[2])));
  }
}

}  // namespace
}  // namespace ream::test
