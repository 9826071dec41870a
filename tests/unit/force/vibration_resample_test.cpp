#include "force/vibration/vibration_signal.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/spectrum.hpp"

namespace ream::force {
namespace {

std::vector<float> tone(double frequency_hz, double rate_hz, size_t samples, double phase_rad = 0.0) {
  std::vector<float> signal(samples);
  for (size_t i = 0; i < samples; ++i)
    signal[i] = static_cast<float>(
        std::sin(2.0 * pi * std::fmod(frequency_hz * static_cast<double>(i) / rate_hz, 1.0) + phase_rad));
  return signal;
}

/// A loop of two seconds with a whole number of waves, so that there is no border anywhere.
std::vector<float> loop_of(double frequency_hz) { return tone(frequency_hz, 22050.0, 44100, 0.7); }

TEST(Resampling, KeepsTonesThatAHandFeelsWhereTheyAre) {
  for (const double f : {1.0, 13.0, 100.0, 250.0, 399.0, 450.0}) {
    const std::vector<float> got = resampled_loop(loop_of(f), 22050.0, 1000.0);
    const std::vector<float> expected = tone(f, 1000.0, 2000, 0.7);
    ASSERT_EQ(got.size(), expected.size());
    for (size_t i = 0; i < got.size(); ++i) ASSERT_NEAR(got[i], expected[i], 0.01) << f << " Hz, tick " << i;
  }
}

TEST(Resampling, GoesUpToTheTracksRate) {
  for (const double f : {1.0, 100.0, 399.0, 450.0}) {
    const std::vector<float> got = resampled_loop(tone(f, 1000.0, 2000, 0.7), 1000.0, 4000.0);
    const std::vector<float> expected = tone(f, 4000.0, 8000, 0.7);
    ASSERT_EQ(got.size(), expected.size());
    for (size_t i = 0; i < got.size(); ++i)
      ASSERT_NEAR(got[i], expected[i], 0.01) << f << " Hz, sample " << i;
  }
}

TEST(Resampling, SuppressesWhatTheNewRateCannotHold) {
  for (const double f : {500.0, 550.0, 600.0, 700.0, 999.0, 1100.0, 2205.0, 5000.0, 11000.0})
    for (const float sample : resampled_loop(loop_of(f), 22050.0, 1000.0))
      ASSERT_NEAR(sample, 0.0, 1e-3) << f << " Hz";
}

TEST(Resampling, GoesUpAndDownBetweenOtherRates) {
  for (const double from_hz : {1000.0, 8000.0, 22050.0, 44100.0, 48000.0, 192000.0})
    for (const double to_hz : {1000.0, 22050.0}) {
      const auto samples = static_cast<size_t>(2.0 * from_hz);
      const std::vector<float> got = resampled(tone(170.0, from_hz, samples), from_hz, to_hz);
      const std::vector<float> expected = tone(170.0, to_hz, static_cast<size_t>(2.0 * to_hz));
      ASSERT_NEAR(static_cast<double>(got.size()), 2.0 * to_hz, 2.0 + to_hz / from_hz);
      const auto border = static_cast<size_t>(0.2 * to_hz);
      for (size_t i = border; i + border < got.size(); ++i)
        ASSERT_NEAR(got[i], expected[i], 0.01) << from_hz << " to " << to_hz << " Hz, sample " << i;
    }
}

}  // namespace
}  // namespace ream::force
