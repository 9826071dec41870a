#include "force/vibration/vibration_player.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/units.hpp"
#include "support/spectrum.hpp"

namespace ream::force {
namespace {

constexpr double speed_rad_s = rad_s_from_rpm(156.0);
constexpr VibrationInput off{false, speed_rad_s, false, {}};
constexpr VibrationInput turning_free{true, speed_rad_s, false, {}};

VibrationInput reaming(double cancellous, double cortical, double cartilage = 0.0) {
  return {true, speed_rad_s, true, {cancellous, cortical, cartilage}};
}

/// Tracks that say a constant, so that the player's output is the sum of its gains.
std::shared_ptr<const VibrationTracks> constant_tracks(std::array<float, vibration_kinds> g) {
  auto tracks = std::make_shared<VibrationTracks>();
  for (size_t k = 0; k < vibration_kinds; ++k) {
    tracks->by_kind[k].assign((k + 1) * 80, g[k]);
  }
  return tracks;
}

double mean_square(VibrationPlayer& player, const VibrationInput& input, int ticks) {
  double sum = 0.0;
  for (int i = 0; i < ticks; ++i) {
    const double g = player.next_g(input);
    sum += g * g;
  }
  return sum / ticks;
}

TEST(VibrationPlayer, WithoutTracksIsStill) {
  VibrationPlayer player;
  VibrationPlayer off_source(make_vibration_tracks({.source = VibrationSource::off, .recordings = {}}, 1), 1);
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(player.next_g(reaming(0.0, 1.0)), 0.0);
    EXPECT_EQ(off_source.next_g(turning_free), 0.0);
  }
}

TEST(VibrationPlayer, FadesWithoutAStep) {
  VibrationPlayer player(constant_tracks({1.0f, 1.0f, 1.0f, 1.0f}), 3);
  double before = 0.0;
  const auto run = [&](const VibrationInput& input, int ticks) {
    for (int i = 0; i < ticks; ++i) {
      const double g = player.next_g(input);
      // Two kinds may change by a fiftieth each; the lips turn by 0.08 rad a tick.
      ASSERT_LE(std::abs(g - before), 2.0 / 50.0 * (1.0 + lip_pass_depth) + 0.082 * lip_pass_depth * 1.5);
      before = g;
    }
  };
  run(off, 100);
  EXPECT_EQ(before, 0.0);
  run(turning_free, 25);
  EXPECT_NEAR(before, 0.5, 1e-12);
  run(turning_free, 25);
  EXPECT_NEAR(before, 1.0, 1e-12) << "idle spin is not modulated";
  run(reaming(0.3, 0.7), 100);
  run(reaming(1.0, 0.0), 100);
  run(turning_free, 100);
  EXPECT_NEAR(before, 1.0, 1e-12);
  run(off, 50);
  EXPECT_NEAR(before, 0.0, 1e-12);
}

TEST(VibrationPlayer, APauseIsStillAndFadesInAgain) {
  VibrationPlayer player(constant_tracks({1.0f, 1.0f, 1.0f, 1.0f}), 3);
  for (int i = 0; i < 60; ++i) player.next_g(turning_free);
  VibrationInput paused = turning_free;
  paused.paused = true;
  EXPECT_EQ(player.next_g(paused), 0.0);
  EXPECT_NEAR(player.next_g(turning_free), 1.0 / 50.0, 1e-12);
}

TEST(VibrationPlayer, LipPassesKeepTheMeanSquare) {
  VibrationPlayer player(constant_tracks({1.0f, 0.0f, 0.0f, 0.0f}), 3);
  mean_square(player, reaming(1.0, 0.0), 1000);
  EXPECT_NEAR(mean_square(player, reaming(1.0, 0.0), 10000), 1.0, 1e-3);
}

TEST(VibrationPlayer, LipsPassFiveTimesATurn) {
  const auto tracks = make_vibration_tracks({}, 9);
  for (const double rpm : {60.0, 156.0, 240.0}) {
    VibrationPlayer player(tracks, 9);
    VibrationInput input = reaming(0.0, 1.0);
    input.spindle_speed_rad_s = rad_s_from_rpm(rpm);
    std::vector<double> squares(60000);
    for (double& square : squares) {
      const double g = player.next_g(input);
      square = g * g;
    }
    const auto part = [&](double frequency_hz) {
      const std::span<const double> all(squares);
      return 2.0 * std::sqrt(test::power_at(all, frequency_hz, 1000.0) / test::power_at(all, 0.0, 1000.0));
    };
    // (1 + d cos)^2 over its mean swings by 2 d / (1 + d^2 / 2) at the lips' frequency.
    const double lips_hz = rpm / 60.0 * 5.0;
    EXPECT_NEAR(part(lips_hz), 2.0 * lip_pass_depth / (1.0 + 0.5 * lip_pass_depth * lip_pass_depth), 0.15);
    for (const double beside_hz : {0.6, 0.8, 1.2, 1.4})
      EXPECT_LT(part(beside_hz * lips_hz), 0.5 * part(lips_hz)) << rpm << " rpm";
  }
}

TEST(VibrationPlayer, VariancesAddByShare) {
  constexpr double cancellous_g2 = 0.40 * 0.40, cortical_g2 = 0.30 * 0.30, cartilage_g2 = 0.10 * 0.10;
  const auto tracks = make_vibration_tracks({}, 11);
  for (const double share : {0.0, 0.25, 0.5, 0.9, 1.0}) {
    VibrationPlayer player(tracks, 11);
    const VibrationInput input = reaming(share * 0.8, 0.8 * (1.0 - share), 0.2);
    mean_square(player, input, 100);
    const double expected = 0.8 * (share * cancellous_g2 + (1.0 - share) * cortical_g2) + 0.2 * cartilage_g2;
    EXPECT_NEAR(mean_square(player, input, 60000) / expected, 1.0, 0.05) << share;
  }
  VibrationPlayer player(tracks, 11);
  mean_square(player, turning_free, 100);
  EXPECT_NEAR(mean_square(player, turning_free, 20000) / (0.05 * 0.05), 1.0, 1e-6) << "a whole loop";
}

/// Median frequency of the power below 500 Hz, Hz.
double median_hz(const VibrationTracks& tracks, const VibrationInput& input) {
  VibrationPlayer player(std::make_shared<const VibrationTracks>(tracks), 5);
  std::vector<double> g(60000);
  for (double& sample : g) sample = player.next_g(input);
  const std::vector<double> bins = test::welch_1khz(g);
  const double half = 0.5 * test::band_power(bins, 0, 500);
  size_t f = 1;
  while (test::band_power(bins, 0, f) < half) ++f;
  return static_cast<double>(f);
}

TEST(VibrationPlayer, TheSpectrumFollowsSpeedAndBone) {
  auto tracks = *make_vibration_tracks({}, 5);
  tracks.by_kind[static_cast<size_t>(VibrationKind::idle)].assign(80, 0.0f);
  const auto at_rpm = [&](VibrationInput input, double rpm) {
    input.spindle_speed_rad_s = rad_s_from_rpm(rpm);
    return median_hz(tracks, input);
  };
  const double cancellous = at_rpm(reaming(1.0, 0.0), 156.0), cortical = at_rpm(reaming(0.0, 1.0), 156.0),
               cartilage = at_rpm(reaming(0.0, 0.0, 1.0), 156.0);
  EXPECT_LT(1.3 * cartilage, cancellous);
  EXPECT_LT(1.05 * cancellous, cortical) << "what is above 500 Hz is not felt";
  for (const double share : {0.25, 0.5, 0.75}) {
    EXPECT_NEAR(at_rpm(reaming(1.0, 0.0), 156.0 * share) / cancellous, share, 0.05) << share;
    EXPECT_LT(at_rpm(reaming(0.0, 1.0), 156.0 * share), cortical) << share;
  }
}

/// Reading between samples must not make a drill quieter that is a little slower than the experiments'.
TEST(VibrationPlayer, StrengthDoesNotDependOnWhereSamplesFall) {
  const auto tracks = make_vibration_tracks({}, 6);
  const auto at_share = [&](double share) {
    VibrationPlayer player(tracks, 6);
    VibrationInput input = reaming(0.0, 1.0);
    input.spindle_speed_rad_s = share * speed_rad_s;
    return mean_square(player, input, 60000);
  };
  const double whole = at_share(1.0);
  for (const double share : {0.999, 0.97, 0.9, 0.61}) EXPECT_NEAR(at_share(share) / whole, 1.0, 0.1) << share;
}

TEST(VibrationPlayer, TheSeedChoosesWhereTracksStart) {
  const auto tracks = make_vibration_tracks({}, 1);
  const auto first = [&](uint64_t seed) {
    VibrationPlayer player(tracks, seed);
    std::vector<double> g(100);
    for (double& sample : g) sample = player.next_g(reaming(0.5, 0.5));
    return g;
  };
  EXPECT_EQ(first(1), first(1));
  EXPECT_NE(first(1), first(2));
}

}  // namespace
}  // namespace ream::force
