#include "force/vibration/vibration_recording.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "force/vibration/vibration_tracks.hpp"
#include "support/expect_error.hpp"
#include "support/recording_files.hpp"
#include "support/seed.hpp"
#include "support/spectrum.hpp"
#include "support/temporary_folder.hpp"

namespace ream::force {
namespace {

using test::expect_error;

constexpr auto cortical_kind = static_cast<size_t>(VibrationKind::cortical);

/// Gravity, a slow swing and noise, as an accelerometer on a reamer says it.
std::vector<float> raw_signal(double rate_hz, double seconds, double unit = 1.0, double gravity_g = 1.0) {
  std::mt19937_64 random(test::seed(20260411));
  std::uniform_real_distribution<double> even(-1.0, 1.0);
  std::vector<double> tones_hz(40), phases_rad(40);
  for (double& f : tones_hz) f = 230.0 + 170.0 * even(random);
  for (double& p : phases_rad) p = pi * even(random);
  std::vector<float> signal(static_cast<size_t>(rate_hz * seconds));
  for (size_t i = 0; i < signal.size(); ++i) {
    const double t_s = static_cast<double>(i) / rate_hz;
    double sum = gravity_g + 0.05 * std::sin(2.0 * pi * 0.05 * t_s);
    for (size_t k = 0; k < tones_hz.size(); ++k)
      sum += 0.05 * std::sin(2.0 * pi * tones_hz[k] * t_s + phases_rad[k]);
    signal[i] = static_cast<float>(unit * sum);
  }
  return signal;
}

class Recordings : public testing::Test {
 protected:
  /// The cortical_kind track of a recording file.
  VibrationTrack track_of(const std::string& name, const std::string& bytes, double rate_hz = 0.0) const {
    VibrationSettings settings;
    settings.source = VibrationSource::recording;
    settings.recordings.cortical = settings.recordings.cancellous = folder_.write(name, bytes);
    settings.recordings.rate_hz = rate_hz;
    return make_vibration_tracks(settings, 1)->by_kind[cortical_kind];
  }

  void refused(const std::string& name, const std::string& bytes, const std::string& mentioned,
               double rate_hz = 0.0) const {
    expect_error(ErrorKind::invalid_input, mentioned, [&] { track_of(name, bytes, rate_hz); });
  }

  /// Root mean square of the difference, as part of the track's.
  static double difference(const std::vector<float>& a, const std::vector<float>& b) {
    if (a.size() != b.size()) return std::numeric_limits<double>::infinity();
    std::vector<float> d(a.size());
    for (size_t i = 0; i < a.size(); ++i) d[i] = a[i] - b[i];
    return rms(d) / rms(a);
  }

  test::TemporaryFolder folder_;
};

TEST_F(Recordings, WavAndBothFormsOfCsvGiveTheSameTrack) {
  const std::vector<float> signal = raw_signal(22050.0, 3.0);
  const VibrationTrack wav = track_of("a.wav", test::wav_bytes(signal, 22050));
  const VibrationTrack csv = track_of("a.csv", test::csv_text(signal), 22050.0);
  EXPECT_EQ(wav, csv);
  EXPECT_EQ(wav, track_of("B.WAV", test::wav_bytes(signal, 22050)));
  const VibrationTrack timed = track_of("t.csv", test::timed_csv_text(signal, 22050.0, 17.0));
  EXPECT_LT(difference(wav, timed), 1e-3) << "times have nine digits";
}

TEST_F(Recordings, HaveThePublishedRms) {
  const VibrationTrack track = track_of("a.wav", test::wav_bytes(raw_signal(22050.0, 3.3), 22050));
  EXPECT_NEAR(rms(track), 0.30, 1e-7);
  EXPECT_EQ(track.size() % 80, 0u) << "beats of 20 ms";
  EXPECT_NEAR(static_cast<double>(track.size()), 4.0 * 2800.0, 80.0) << "half a second goes into the seam";
}

TEST_F(Recordings, UnitAndGravityDoNotMatter) {
  const VibrationTrack plain = track_of("a.wav", test::wav_bytes(raw_signal(22050.0, 3.0, 1.0, 0.0), 22050));
  const VibrationTrack other = track_of("b.wav", test::wav_bytes(raw_signal(22050.0, 3.0, 0.01, 1.0), 22050));
  EXPECT_LT(difference(plain, other), 1e-3);
}

TEST_F(Recordings, TheRateOfTheRecordingDoesNotMatter) {
  const VibrationTrack plain = track_of("a.wav", test::wav_bytes(raw_signal(22050.0, 3.0), 22050));
  for (const double rate_hz : {2000.0, 44100.0, 51200.0}) {
    const std::vector<float> signal = raw_signal(rate_hz, 3.0);
    const VibrationTrack track = track_of("r.csv", test::csv_text(signal), rate_hz);
    // At the ends the resampler meets silence instead of gravity; the middle is what was recorded.
    const auto middle = [](const VibrationTrack& t) {
      return std::vector<float>(t.begin() + 2400, t.begin() + 9200);
    };
    EXPECT_LT(difference(middle(plain), middle(track)), 0.03) << rate_hz;
  }
}

TEST_F(Recordings, TheEndLeadsIntoTheBeginning) {
  std::vector<float> swing(3 * 22050 + 1234);  // 21.37 Hz: its end does not fit its beginning
  for (size_t i = 0; i < swing.size(); ++i)
    swing[i] = std::sin(static_cast<float>(2.0 * pi * 21.37 / 22050.0 * static_cast<double>(i)));
  const VibrationTrack track = track_of("a.wav", test::wav_bytes(swing, 22050));
  const auto largest_step = [](const std::vector<float>& t) {
    float largest = 0.0f;
    for (size_t i = 1; i < t.size(); ++i) largest = std::max(largest, std::abs(t[i] - t[i - 1]));
    return largest;
  };
  EXPECT_LE(std::abs(track.front() - track.back()), 1.01f * largest_step(track));
}

TEST_F(Recordings, IdleIsSynthesizedUnlessItIsGiven) {
  VibrationSettings settings;
  settings.source = VibrationSource::recording;
  settings.recordings.cortical = settings.recordings.cancellous =
      folder_.write("bone.wav", test::wav_bytes(raw_signal(22050.0, 3.0), 22050));
  constexpr auto idle = static_cast<size_t>(VibrationKind::idle);
  EXPECT_GT(make_vibration_tracks(settings, 1)->by_kind[idle].size(), 40000u);
  settings.recordings.idle = folder_.write("idle.wav", test::wav_bytes(raw_signal(22050.0, 2.5), 22050));
  EXPECT_LT(make_vibration_tracks(settings, 1)->by_kind[idle].size(), 10400u);
  settings.recordings.cancellous.clear();
  expect_error(ErrorKind::invalid_input, "cancellous_file", [&] { make_vibration_tracks(settings, 1); });
}

TEST_F(Recordings, FilesThatCannotBeUsedAreNamedWithTheLine) {
  const std::string many = test::csv_text(raw_signal(22050.0, 2.5));
  refused("a.csv", many, "a.csv has no times");
  refused("a.csv", "g\n1\n2\nthree\n", "a.csv:4 must hold a finite number, not 'three'", 22050.0);
  refused("a.csv", "1\n2\nnan\n", "a.csv:3", 22050.0);
  refused("a.csv", "1\n1e999\n", "a.csv:2", 22050.0);
  refused("a.csv", "0.0,1\n0.1,2\n", "a.csv:1 must hold one number of g; two columns", 22050.0);
  refused("a.csv", "time_s,g\n0,1\n5\n", "a.csv:3");
  refused("a.csv", "time_s,g\n0,1\n0.0001,2,3\n", "a.csv:3");
  refused("a.csv", "time_s,g\n0,1\n0.0001,2\n0.0002,3\n0.0009,4\n0.001,4\n",
          "a.csv:5 breaks the even spacing");
  refused("a.csv", "time_s,g\n1,1\n0.5,2\n", "do not ascend");
  refused("a.csv", "time_s,g\n0,1\n0.01,2\n", "sampled at 100 Hz");
  refused("a.csv", "", "fewer than two samples", 22050.0);
  refused("a.csv", test::csv_text(std::vector<float>(60000, 0.5f)), "is still", 22050.0);
  refused("a.csv", test::csv_text(raw_signal(22050.0, 1.9)), "shorter than 2 s", 22050.0);
  refused("a.mp3", "ID3", "a.mp3 is no vibration recording");
  expect_error(ErrorKind::not_found, "absent.wav",
               [&] { read_vibration_recording(folder_.path() / "absent.wav", 0.0); });
}

TEST_F(Recordings, WavFilesThatCannotBeUsedAreNamed) {
  const std::vector<float> signal = raw_signal(22050.0, 2.5);
  const std::string good = test::wav_bytes(signal, 22050);
  refused("a.wav", "RIFFnothing", "a.wav cannot be read as sound");
  refused("a.wav", test::wav_bytes(signal, 22050, 2), "a.wav has 2 channels");
  refused("a.wav", good.substr(0, 44), "fewer than two samples");
  refused("a.wav", test::wav_bytes(signal, 500), "sampled at 500 Hz");
  std::vector<float> odd = signal;
  odd[7] = std::numeric_limits<float>::quiet_NaN();
  refused("a.wav", test::wav_bytes(odd, 22050), "at sample 7");
}

}  // namespace
}  // namespace ream::force
