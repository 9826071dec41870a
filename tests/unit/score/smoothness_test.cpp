#include "score/tool_path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <random>
#include <vector>

#include "core/units.hpp"
#include "support/seed.hpp"

namespace ream::score {
namespace {

/// exp(-5 t^2), t = -1, -0.99, ..., 0.99: the vector of the authors' program.
std::vector<double> bell() {
  std::vector<double> speed;
  for (int i = 0; i < 200; ++i) {
    const double t = -1.0 + 0.01 * i;
    speed.push_back(std::exp(-5.0 * t * t));
  }
  return speed;
}

/// Speed of a movement of least jerk of length 1 in one second, at 200 Hz.
std::vector<double> least_jerk() {
  std::vector<double> speed;
  for (int i = 0; i <= 200; ++i) {
    const double t = i / 200.0;
    speed.push_back(30.0 * t * t * (1.0 - t) * (1.0 - t));
  }
  return speed;
}

/// The definitions once more: a plain discrete Fourier transform, sums as they are written down.
double plain_sparc(const std::vector<double>& speed, double rate_hz) {
  size_t padded = 1;
  while (padded < speed.size()) padded *= 2;
  padded *= 16;
  std::vector<double> magnitude;
  for (size_t k = 0; static_cast<double>(k) * rate_hz / static_cast<double>(padded) <= 10.0 && k < padded;
       ++k) {
    std::complex<double> sum = 0.0;
    for (size_t i = 0; i < speed.size(); ++i)
      sum += speed[i] * std::polar(1.0, -2.0 * pi * static_cast<double>(k * i) / static_cast<double>(padded));
    magnitude.push_back(std::abs(sum));
  }
  const double greatest = *std::max_element(magnitude.begin(), magnitude.end());
  std::vector<size_t> loud;
  for (size_t k = 0; k < magnitude.size(); ++k)
    if (magnitude[k] / greatest >= 0.05) loud.push_back(k);
  double length = 0.0;
  for (size_t k = loud.front(); k < loud.back(); ++k)
    length += std::hypot(1.0 / static_cast<double>(loud.back() - loud.front()),
                         (magnitude[k + 1] - magnitude[k]) / greatest);
  return -length;
}

double plain_ldlj(const std::vector<double>& speed, double rate_hz) {
  double peak = 0.0, sum = 0.0;
  for (const double v : speed) peak = std::max(peak, std::abs(v));
  for (size_t i = 0; i + 2 < speed.size(); ++i) {
    const double jerk = ((speed[i + 2] - speed[i + 1]) - (speed[i + 1] - speed[i])) * rate_hz * rate_hz;
    sum += jerk * jerk / rate_hz;
  }
  const double duration = static_cast<double>(speed.size()) / rate_hz;
  return -std::log(std::pow(duration, 3) / (peak * peak) * sum);
}

TEST(Smoothness, IsThatOfTheAuthorsProgram) {
  EXPECT_NEAR(*spectral_arc_length(bell(), 100.0), -1.41403, 1e-5);
  EXPECT_NEAR(*log_dimensionless_jerk(bell(), 100.0), -5.81636, 1e-5);
  EXPECT_NEAR(-std::exp(-*log_dimensionless_jerk(bell(), 100.0)), -335.74684, 1e-4);
  EXPECT_NEAR(*spectral_arc_length(least_jerk(), 200.0), -1.4058, 1e-4);
  EXPECT_NEAR(*log_dimensionless_jerk(least_jerk(), 200.0), -5.3119, 1e-4);
}

TEST(Smoothness, IsThatOfAPlainTransformOnAnySpeed) {
  std::mt19937 random(test::seed(907));
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  for (const size_t count : {20u, 33u, 64u, 65u, 150u}) {
    std::vector<double> speed(count);
    for (size_t i = 0; i < count; ++i)
      speed[i] =
          std::abs(5.0 * std::sin(pi * static_cast<double>(i) / static_cast<double>(count)) + number(random));
    EXPECT_NEAR(*spectral_arc_length(speed, 100.0), plain_sparc(speed, 100.0), 1e-9) << count;
    EXPECT_NEAR(*log_dimensionless_jerk(speed, 100.0), plain_ldlj(speed, 100.0), 1e-9) << count;
  }
}

TEST(Smoothness, DoesNotDependOnHowFastTheMovementIs) {
  std::vector<double> speed = bell();
  for (double& v : speed) v *= 37.0;
  EXPECT_NEAR(*spectral_arc_length(speed, 100.0), *spectral_arc_length(bell(), 100.0), 1e-12);
  EXPECT_NEAR(*log_dimensionless_jerk(speed, 100.0), *log_dimensionless_jerk(bell(), 100.0), 1e-12);
}

TEST(Smoothness, TwoMovementsInOneAreLessSmooth) {
  std::vector<double> two;
  for (int half = 0; half < 2; ++half)
    for (const double v : least_jerk()) two.push_back(v);
  EXPECT_LT(*spectral_arc_length(two, 200.0), *spectral_arc_length(least_jerk(), 200.0) - 0.5);
  EXPECT_LT(*log_dimensionless_jerk(two, 200.0), *log_dimensionless_jerk(least_jerk(), 200.0) - 1.0);
}

TEST(Smoothness, IsNotSaidOfWhatIsNoMovement) {
  const double not_a_number = std::numeric_limits<double>::quiet_NaN();
  for (const std::vector<double>& speed : {std::vector<double>{},
                                           {1.0},
                                           {1.0, 2.0},
                                           std::vector<double>(50, 0.0),
                                           std::vector<double>{1.0, not_a_number, 1.0, 2.0}}) {
    EXPECT_FALSE(spectral_arc_length(speed, 100.0));
    EXPECT_FALSE(log_dimensionless_jerk(speed, 100.0));
  }
  EXPECT_FALSE(spectral_arc_length(bell(), 0.0));
  EXPECT_FALSE(log_dimensionless_jerk(std::vector<double>(50, 2.0), 100.0)) << "no jerk at all has no log";
}

}  // namespace
}  // namespace ream::score
