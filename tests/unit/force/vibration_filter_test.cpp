#include "force/vibration/vibration_signal.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <vector>

#include "core/units.hpp"

namespace ream::force {
namespace {

constexpr double played_hz = 22050.0;

/// Magnitude of the filter at one frequency, from its answer to a single impulse.
double measured(const std::vector<double>& answer, double frequency_hz) {
  std::complex<double> sum = 0.0;
  for (size_t i = 0; i < answer.size(); ++i)
    sum += answer[i] *
           std::polar(1.0, -2.0 * pi * std::fmod(frequency_hz * static_cast<double>(i) / played_hz, 1.0));
  return std::abs(sum);
}

std::vector<double> impulse_answer(const Butterworth4& filter, double seconds) {
  std::vector<double> signal(static_cast<size_t>(seconds * played_hz), 0.0);
  signal[0] = 1.0;
  filter_in_place(filter, signal);
  return signal;
}

/// Butterworth's own formula for order four, after the bilinear transform's bend of the frequency axis.
double analytic(double ratio) { return 1.0 / std::sqrt(1.0 + std::pow(ratio, 8.0)); }
double bent(double frequency_hz) { return std::tan(pi * frequency_hz / played_hz); }

TEST(Butterworth, LowPassHasTheAnalyticMagnitude) {
  const std::vector<double> answer = impulse_answer(butterworth_low_pass(500.0, played_hz), 0.5);
  for (const double f : {5.0, 50.0, 100.0, 200.0, 300.0, 400.0, 500.0, 700.0, 1000.0, 2000.0}) {
    EXPECT_NEAR(measured(answer, f), analytic(bent(f) / bent(500.0)), 1e-9) << f << " Hz";
    // Far below half the rate the bend hardly shows: this is the analog filter.
    if (f > 1000.0) continue;
    EXPECT_NEAR(measured(answer, f), analytic(f / 500.0), 4e-3) << f << " Hz";
  }
  EXPECT_NEAR(measured(answer, 500.0), std::sqrt(0.5), 1e-9);
}

TEST(Butterworth, HighPassHasTheAnalyticMagnitude) {
  const std::vector<double> answer = impulse_answer(butterworth_high_pass(0.2, played_hz), 40.0);
  for (const double f : {0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.5, 1.0, 10.0, 400.0})
    EXPECT_NEAR(measured(answer, f), analytic(bent(0.2) / bent(f)), 1e-4) << f << " Hz";
}

TEST(Butterworth, HighPassForgetsGravity) {
  std::vector<double> gravity(static_cast<size_t>(60.0 * played_hz), 1.0);
  filter_in_place(butterworth_high_pass(0.2, played_hz), gravity);
  EXPECT_NEAR(gravity.back(), 0.0, 1e-9);
}

}  // namespace
}  // namespace ream::force
