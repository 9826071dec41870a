#include "force/vibration/vibration_player.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/units.hpp"
#include "force/vibration/vibration_signal.hpp"
#include "support/spectrum.hpp"
#include "unit/force/vibration_sound.hpp"

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
    tracks->by_kind[k].device_g.assign((k + 1) * ticks_a_beat, g[k]);
    tracks->by_kind[k].sound_g.assign((k + 1) * sound_samples_a_beat, g[k]);
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

TEST(VibrationSound, HasSamplesForEveryTick) {
  VibrationSound sound(constant_tracks({0.0f, 0.0f, 0.0f, 2.0f}), 3);
  std::vector<float> samples;
  sound.render(std::vector<VibrationInput>(1, turning_free), samples);
  EXPECT_EQ(samples.size(), 1u);
  for (int i = 0; i < 20; ++i) sound.render(std::vector<VibrationInput>(1, turning_free), samples);
  EXPECT_EQ(samples.size(), 1u + 441u);
  sound.render(std::vector<VibrationInput>(980, turning_free), samples);
  EXPECT_EQ(samples.size(), 1u + 22050u);
  EXPECT_NEAR(samples.front(), 2.0f / 50.0f, 1e-6);
  EXPECT_NEAR(samples.back(), 2.0f, 1e-6);
  for (size_t i = 1; i < samples.size(); ++i) ASSERT_GE(samples[i], samples[i - 1]);
}

TEST(VibrationSound, IsWhatTheHandFeels) {
  const auto tracks = make_vibration_tracks({}, 4);
  VibrationPlayer player(tracks, 17);
  VibrationSound sound(tracks, 17);
  // A loop that begins and ends in silence, so that it can be resampled as one.
  std::vector<VibrationInput> ticks;
  ticks.reserve(4000);
  for (int i = 0; i < 4000; ++i)
    ticks.push_back(i < 500 || i >= 3500 ? off
                    : i < 1000           ? turning_free
                                         : reaming(i / 4000.0, 1.0 - i / 4000.0));
  std::vector<float> heard;
  for (size_t i = 0; i < ticks.size(); i += 500) sound.render(std::span(ticks).subspan(i, 500), heard);
  heard.resize(4000 / ticks_a_beat * sound_samples_a_beat);
  const std::vector<float> heard_at_ticks = loop_at_tick_rate(heard);
  double felt_squares = 0.0, product = 0.0, heard_squares = 0.0;
  for (size_t i = 0; i < ticks.size(); ++i) {
    const double felt = player.next_g(ticks[i]), h = heard_at_ticks[i];
    felt_squares += felt * felt;
    product += felt * h;
    heard_squares += h * h;
  }
  EXPECT_GT(product / std::sqrt(felt_squares * heard_squares), 0.999);
  EXPECT_NEAR(std::sqrt(heard_squares / felt_squares), 1.0, 0.05) << "sound has a little more above 450 Hz";
}

}  // namespace
}  // namespace ream::force
