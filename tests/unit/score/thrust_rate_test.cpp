#include "score/thrust_rate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "core/units.hpp"
#include "support/seed.hpp"

namespace ream::score {
namespace {

record::TickReport pressing(double thrust_n) {
  record::TickReport r;
  r.engaged = r.spindle_on = true;
  r.thrust_n = thrust_n;
  return r;
}

std::optional<double> rate_of(const std::vector<record::TickReport>& ticks) {
  ThrustRate rate;
  for (const record::TickReport& tick : ticks) rate.add(tick);
  MetricResults results;
  rate.write(results);
  return results.value("thrust_rate_percent_s");
}

std::vector<record::TickReport> press(double seconds, const std::function<double(double)>& thrust_n) {
  std::vector<record::TickReport> ticks;
  for (int i = 0; i < static_cast<int>(seconds * 1000.0); ++i) ticks.push_back(pressing(thrust_n(i * 1e-3)));
  return ticks;
}

TEST(ThrustRate, OfASteadyThrustIsNothing) {
  EXPECT_EQ(*rate_of(press(5.0, [](double) { return 52.0; })), 0.0);
  // Put on and taken off within a quarter of a second.
  const auto ramped = [](double t) { return 52.0 * std::min({1.0, t / 0.2, (5.0 - t) / 0.2}); };
  EXPECT_NEAR(*rate_of(press(5.0, ramped)), 0.0, 1e-9);
}

TEST(ThrustRate, OfARampIsItsSlope) {
  EXPECT_NEAR(*rate_of(press(4.0, [](double t) { return 40.0 + 5.0 * t; })), 100.0 * 5.0 / 50.0, 0.05);
}

/// Means over 50 ms weaken a sine, and so does a difference in place of a derivative.
TEST(ThrustRate, OfASineIsThatOfItsFormula) {
  for (const double hz : {0.3, 1.0, 3.0, 7.0}) {
    const double swing_n = 8.0, mean_n = 45.0, dt = 0.05, half_turn = pi * hz * dt;
    const double of_means = swing_n * std::sin(half_turn) / half_turn;
    const double rms_n_s = of_means * 2.0 * std::sin(half_turn) / dt / std::sqrt(2.0);
    const auto sine = [&](double t) { return mean_n + swing_n * std::sin(2.0 * pi * hz * t); };
    const double expected = 100.0 * rms_n_s / mean_n;
    for (const double seconds : {20.55, 200.55})
      EXPECT_NEAR(*rate_of(press(seconds, sine)), expected, 1e-3 * expected)
          << hz << " Hz, " << seconds << " s";
    const auto stronger = [&](double t) { return 1.7 * sine(t); };
    EXPECT_NEAR(*rate_of(press(20.55, stronger)), *rate_of(press(20.55, sine)), 1e-6) << "in proportion";
  }
}

TEST(ThrustRate, NeedsOnePressOfSixTenthsOfASecond) {
  EXPECT_FALSE(rate_of(press(0.599, [](double) { return 20.0; })));
  EXPECT_TRUE(rate_of(press(0.600, [](double) { return 20.0; })));
  std::vector<record::TickReport> broken;
  for (int i = 0; i < 20; ++i) {
    for (const auto& tick : press(0.5, [](double) { return 20.0; })) broken.push_back(tick);
    broken.push_back(pressing(4.9));
  }
  EXPECT_FALSE(rate_of(broken));
  std::vector<record::TickReport> standing = press(5.0, [](double) { return 20.0; });
  for (record::TickReport& r : standing) r.spindle_on = false;
  EXPECT_FALSE(rate_of(standing));
}

/// The same press by press, from lists.
std::optional<double> reference_of(const std::vector<record::TickReport>& ticks) {
  double squares = 0.0, sum = 0.0;
  int changes = 0;
  std::vector<double> thrusts;
  const auto end_press = [&] {
    std::vector<double> means;
    for (size_t i = 0; i + 50 <= thrusts.size(); i += 50) {
      double mean = 0.0;
      for (size_t k = i; k < i + 50; ++k) mean += thrusts[k] / 50.0;
      means.push_back(mean);
    }
    for (size_t i = 5; i + 6 < means.size(); ++i) {
      squares += std::pow((means[i + 1] - means[i]) / 0.05, 2);
      sum += (means[i + 1] + means[i]) / 2.0;
      ++changes;
    }
    thrusts.clear();
  };
  for (const record::TickReport& r : ticks) {
    if (r.engaged && r.spindle_on && !r.paused && r.thrust_n >= 5.0)
      thrusts.push_back(r.thrust_n);
    else
      end_press();
  }
  end_press();
  if (changes == 0) return std::nullopt;
  return 100.0 * std::sqrt(squares / changes) / (sum / changes);
}

TEST(ThrustRate, IsThatOfTheListOfAllPresses) {
  const unsigned seed = test::seed(72);
  int judged = 0;
  for (unsigned n = 0; n < 50; ++n) {
    std::mt19937 random(seed + n);
    std::vector<record::TickReport> ticks;
    double thrust = 30.0;
    bool on = true;
    for (int i = 0; i < 8000; ++i) {
      thrust = 30.0 + 0.995 * (thrust - 30.0) + static_cast<double>(random() % 1001) / 500.0 - 1.0;
      if (random() % 1500 == 0) on = !on;
      ticks.push_back(pressing(thrust));
      ticks.back().engaged = on;
      ticks.back().paused = random() % 3000 == 0;
    }
    const auto said = rate_of(ticks), truth = reference_of(ticks);
    ASSERT_EQ(said.has_value(), truth.has_value()) << "seed " << seed + n;
    if (!truth) continue;
    ++judged;
    EXPECT_NEAR(*said, *truth, 1e-5 * *truth + 1e-6) << "seed " << seed + n;
  }
  EXPECT_GT(judged, 40);
}

}  // namespace
}  // namespace ream::score
