#include "device/simulated/hand_model.hpp"

#include <gtest/gtest.h>

#include <complex>
#include <vector>

#include "core/clock.hpp"
#include "core/units.hpp"

namespace ream::device {
namespace {

constexpr int tremor_samples = 120000;  // two minutes

std::vector<Vec3> tremor_of(uint64_t seed, double rms_n, int count = tremor_samples) {
  Tremor tremor(seed, rms_n);
  tremor.begin();
  std::vector<Vec3> force_n;
  for (int i = 0; i < count; ++i) force_n.push_back(tremor.next());
  return force_n;
}

/// Mean square of a component's part between two frequencies, from the discrete Fourier sum of each second.
double power(const std::vector<Vec3>& force_n, int component, int from_hz, int to_hz) {
  constexpr size_t second = 1000;
  double sum = 0.0;
  size_t windows = 0;
  for (size_t start = 0; start + second <= force_n.size(); start += second, ++windows)
    for (int hz = from_hz; hz < to_hz; ++hz) {
      std::complex<double> c;
      for (size_t i = 0; i < second; ++i)
        c += force_n[start + i][component] * std::polar(1.0, 2.0 * pi * hz * static_cast<double>(i) * tick_s);
      sum += 2.0 * std::norm(c) / (1000.0 * 1000.0);
    }
  return sum / static_cast<double>(windows);
}

TEST(Tremor, HasTheRootMeanSquareAskedFor) {
  const auto force_n = tremor_of(7, 1.5);
  Vec3 squares = Vec3::Zero(), mean = Vec3::Zero();
  for (const Vec3& f : force_n) {
    squares += f.cwiseProduct(f);
    mean += f;
  }
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(std::sqrt(squares[k] / tremor_samples), 1.5, 0.05 * 1.5) << "component " << k;
    EXPECT_NEAR(mean[k] / tremor_samples, 0.0, 0.01);
  }
}

TEST(Tremor, LiesBetweenEightAndTwelveHertz) {
  const auto force_n = tremor_of(8, 1.0, 20000);
  for (int k = 0; k < 3; ++k) {
    // Its edges are 3 dB down, so a part lies beyond them; 20 s tell it to about a tenth.
    EXPECT_GT(power(force_n, k, 7, 14), 0.75) << "component " << k;
    EXPECT_LT(power(force_n, k, 0, 4), 0.03);
    EXPECT_LT(power(force_n, k, 25, 60), 0.03);
  }
}

TEST(Tremor, FollowsItsSeedAndNothingElse) {
  EXPECT_EQ(tremor_of(3, 1.0, 500), tremor_of(3, 1.0, 500));
  EXPECT_NE(tremor_of(3, 1.0, 500), tremor_of(4, 1.0, 500));
  Tremor tremor(3, 1.0);
  tremor.begin();
  for (int i = 0; i < 100; ++i) tremor.next();
  tremor.begin();
  EXPECT_EQ(tremor.next(), tremor_of(3, 1.0, 1)[0]);
}

TEST(Tremor, DirectionsAreIndependent) {
  double product = 0.0;
  for (const Vec3& f : tremor_of(9, 1.0)) product += f.x() * f.y();
  EXPECT_NEAR(product / tremor_samples, 0.0, 0.1);
}

TEST(Tremor, NoneIsNothing) {
  for (const Vec3& f : tremor_of(5, 0.0, 100)) EXPECT_EQ(f, Vec3(0, 0, 0));
}

}  // namespace
}  // namespace ream::device
