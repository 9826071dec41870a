#include "force/vibration/vibration_tracks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <map>

#include "core/units.hpp"
#include "force/vibration/vibration_player.hpp"
#include "support/spectrum.hpp"

namespace ream::force {
namespace {

/// Thesis table 5.2: mean and deviation over the specimens.
struct Published {
  VibrationKind kind;
  double g_rms, peak_to_peak_g, deviation_g;
};
constexpr Published published[] = {{VibrationKind::cancellous, 0.40, 5.28, 0.95},
                                   {VibrationKind::cortical, 0.30, 4.93, 1.06}};
constexpr uint64_t seeds[] = {1, 2, 3, 20260411};
constexpr size_t minute_ticks = 60000;

VibrationInput reaming(VibrationKind kind) {
  VibrationInput input{true, rad_s_from_rpm(156.0), kind != VibrationKind::idle, {}};
  if (input.cutting) input.share[static_cast<size_t>(kind)] = 1.0;
  return input;
}

/// Kept, as making them takes a while.
std::shared_ptr<const VibrationTracks> tracks_of(uint64_t seed) {
  static std::map<uint64_t, std::shared_ptr<const VibrationTracks>> kept;
  auto& tracks = kept[seed];
  if (!tracks) tracks = make_vibration_tracks({}, seed);
  return tracks;
}

/// A minute of what the hand is given.
std::vector<double> minute_of(VibrationKind kind, uint64_t seed) {
  VibrationPlayer player(tracks_of(seed), seed);
  std::vector<double> g(minute_ticks);
  for (double& sample : g) sample = player.next_g(reaming(kind));
  return g;
}

double root_mean_square(const std::vector<double>& signal) {
  double sum = 0.0;
  for (const double sample : signal) sum += sample * sample;
  return std::sqrt(sum / static_cast<double>(signal.size()));
}

/// Peak-to-peak of each of twelve windows of five seconds.
std::vector<double> peaks_to_peaks(const std::vector<double>& minute) {
  std::vector<double> peaks;
  const size_t window = minute.size() / 12;
  for (size_t i = 0; i < 12; ++i) {
    const auto first = minute.begin() + static_cast<std::ptrdiff_t>(i * window);
    const auto [least, most] = std::minmax_element(first, first + static_cast<std::ptrdiff_t>(window));
    peaks.push_back(*most - *least);
  }
  return peaks;
}

TEST(SynthesizedVibration, HasThePublishedStrengthInEveryWindow) {
  for (const uint64_t seed : seeds) {
    std::cout << "seed " << seed << '\n';
    for (const Published& p : published) {
      const std::vector<double> minute = minute_of(p.kind, seed);
      EXPECT_NEAR(root_mean_square(minute) / p.g_rms, 1.0, 0.03);
      for (const double g : peaks_to_peaks(minute)) EXPECT_NEAR(g, p.peak_to_peak_g, p.deviation_g);
    }
  }
}

TEST(SynthesizedVibration, BoneIsImpulsiveAndTheIdleDrillIsNot) {
  for (const uint64_t seed : seeds) {
    for (const Published& p : published) {
      const std::vector<double> minute = minute_of(p.kind, seed);
      for (const double g : peaks_to_peaks(minute)) EXPECT_GT(g / root_mean_square(minute), 10.5);
    }
    for (const VibrationKind kind : {VibrationKind::idle, VibrationKind::cartilage}) {
      const std::vector<double> minute = minute_of(kind, seed);
      for (const double g : peaks_to_peaks(minute)) EXPECT_LT(g / root_mean_square(minute), 10.0);
      EXPECT_LT(root_mean_square(minute), 0.5 * 0.30) << "quieter than bone";
    }
  }
}

TEST(SynthesizedVibration, PowerRisesWithFrequency) {
  for (const Published& p : published) {
    const std::vector<double> bins = test::welch_1khz(minute_of(p.kind, 1));
    for (size_t f = 0; f < 300; f += 50)
      EXPECT_LT(test::band_power(bins, f, f + 50), test::band_power(bins, f + 50, f + 100)) << f << " Hz";
    EXPECT_GT(test::band_power(bins, 250, 500), 2.0 * test::band_power(bins, 0, 250));
  }
}

TEST(SynthesizedVibration, HasNoLineWhereAPlantedOneIsFound) {
  constexpr double threshold = 1.7;
  for (const Published& p : published)
    for (const uint64_t seed : {seeds[0], seeds[3]}) {
      const std::vector<double> plain = minute_of(p.kind, seed);
      EXPECT_LT(test::most_prominent_line(test::welch_1khz(plain)), threshold) << "seed " << seed;
      // A tone with 1 % of the power.
      const double amplitude_g = std::sqrt(2.0 * 0.01) * p.g_rms;
      for (const double f : {60.3, 200.0, 347.5}) {
        std::vector<double> planted = plain;
        for (size_t i = 0; i < planted.size(); ++i)
          planted[i] += amplitude_g * std::sin(2.0 * pi * f * static_cast<double>(i) / 1000.0);
        EXPECT_GT(test::most_prominent_line(test::welch_1khz(planted)), threshold) << f << " Hz";
      }
    }
}

TEST(SynthesizedVibration, ComesFromTheSeedAlone) {
  const auto track_hash = [](uint64_t seed) { return make_vibration_tracks({}, seed)->hash(); };
  const uint64_t first = track_hash(7);
  EXPECT_NE(track_hash(8), first);
  EXPECT_EQ(track_hash(7), first) << "made twice: the eighth took the place of what is kept";
  auto kept = make_vibration_tracks({}, 7);
  EXPECT_EQ(make_vibration_tracks({}, 7), kept) << "shared while it lives";
  const std::weak_ptr<const VibrationTracks> left = kept;
  kept.reset();
  EXPECT_FALSE(left.expired()) << "the last is there for the next session";
  track_hash(8);
  EXPECT_TRUE(left.expired());
}

TEST(SynthesizedVibration, SeedsAndKindsAreIndependent) {
  const auto correlation = [](const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0.0;
    for (size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return std::abs(sum) / static_cast<double>(a.size()) / (root_mean_square(a) * root_mean_square(b));
  };
  // A minute of 300 Hz of bandwidth has a deviation of 0.005.
  const std::vector<double> cortical = minute_of(VibrationKind::cortical, 1);
  EXPECT_LT(correlation(cortical, minute_of(VibrationKind::cortical, 2)), 0.03);
  EXPECT_LT(correlation(cortical, minute_of(VibrationKind::cancellous, 1)), 0.03);
}

}  // namespace
}  // namespace ream::force
