#include "bench/validate/signal.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>
#include <random>

#include "core/units.hpp"
#include "support/seed.hpp"

namespace ream::bench {
namespace {

Signal tone(double amplitude, double frequency_hz, size_t samples) {
  Signal signal(samples);
  for (size_t i = 0; i < samples; ++i)
    signal[i] = amplitude * std::sin(2.0 * pi * frequency_hz * static_cast<double>(i) / 1000.0);
  return signal;
}

Signal noise(size_t samples, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Signal signal(samples);
  for (double& v : signal) v = normal(random);
  return signal;
}

TEST(Signal, RootMeanSquareAndPeaks) {
  EXPECT_DOUBLE_EQ(root_mean_square(std::array{3.0, -3.0, 3.0, -3.0}), 3.0);
  EXPECT_NEAR(root_mean_square(tone(2.0, 50.0, 1000)), std::sqrt(2.0), 1e-12);
  const auto windows = peak_to_peak(std::array{1.0, -2.0, 5.0, 5.0, 9.0}, 2);
  EXPECT_EQ(windows, (std::vector{3.0, 0.0}));
}

TEST(Signal, PeriodogramHoldsATonesPowerAtItsFrequency) {
  const auto power = periodogram(tone(2.0, 120.0, 3000));
  ASSERT_EQ(power.size(), 499u);
  // Mean square of 2 sin is 2; all of it in the bin of 120 Hz.
  EXPECT_NEAR(power[119], 2.0, 1e-9);
  EXPECT_NEAR(std::accumulate(power.begin(), power.end(), 0.0), 2.0, 1e-9);
}

TEST(Signal, WhiteNoiseHasNoLineAndAPlantedOneStandsOut) {
  const uint32_t seed = test::seed(5);
  Signal signal = noise(60000, seed);
  EXPECT_LT(line_strength(periodogram(signal)), 2.0) << "seed " << seed;
  // A tenth of the noise's power in one line.
  const Signal line = tone(std::sqrt(0.2), 233.0, signal.size());
  for (size_t i = 0; i < signal.size(); ++i) signal[i] += line[i];
  EXPECT_GT(line_strength(periodogram(signal)), 10.0) << "seed " << seed;
}

}  // namespace
}  // namespace ream::bench
