#include <cmath>
#include <sstream>

#include "bench/text_table.hpp"
#include "bench/validate/signal.hpp"
#include "bench/validate/validate_parts.hpp"
#include "core/clock.hpp"
#include "core/units.hpp"
#include "force/vibration/vibration_player.hpp"
#include "statistics/sample.hpp"

namespace ream::bench {
namespace {

constexpr double strength_goal_percent = 3.0, peak_goal_deviations = 1.0, line_goal = 2.0;
constexpr uint64_t seed = 1;
constexpr size_t minute_ticks = 60000, window_ticks = 5000, stretches = 5;

/// Table 5.2 of one kind of bone: g_rms and peak-to-peak, g, of its five specimens, with mean and deviation
/// as the text gives them; and the numbers of its pictures, 5.6 and 5.8 or 5.7 and 5.9.
struct PublishedVibration {
  const char* name;
  size_t bone_class;
  std::array<double, 5> g_rms, peak_g;
  MeanAndDeviation mean_g_rms, mean_peak_g;
  int periodogram_figure, sample_figure;
};

constexpr PublishedVibration published[] = {{"cortical",
                                             1,
                                             {0.45, 0.25, 0.31, 0.17, 0.34},
                                             {6.27, 3.98, 5.98, 3.57, 4.83},
                                             {0.30, 0.09},
                                             {4.93, 1.06},
                                             6,
                                             8},
                                            {"cancellous",
                                             0,
                                             {0.45, 0.34, 0.37, 0.51, 0.35},
                                             {5.92, 4.72, 5.09, 3.96, 6.70},
                                             {0.40, 0.07},
                                             {5.28, 0.95},
                                             7,
                                             9}};

/// A minute of reaming one kind of bone, as the tick plays it, after the fade-in.
Signal minute_of(const std::shared_ptr<const force::VibrationTracks>& tracks, size_t bone_class) {
  force::VibrationPlayer player(tracks, seed);
  force::VibrationInput input;
  input.turning = input.cutting = true;
  input.spindle_speed_rad_s = rad_s_from_rpm(published_spindle_rpm);
  input.share[bone_class] = 1.0;
  for (int i = 0; i < 10 * force::vibration_fade_ticks; ++i) player.next_g(input);
  Signal signal(minute_ticks);
  for (double& g : signal) g = player.next_g(input);
  return signal;
}

/// Farthest window from the published mean, in published deviations.
double worst_window(const PublishedVibration& theirs, std::span<const double> windows) {
  double worst = 0.0;
  for (const double g : windows)
    worst = std::max(worst, std::abs(g - theirs.mean_peak_g.mean) / theirs.mean_peak_g.deviation);
  return worst;
}

void print_table(const PublishedVibration& theirs, const Signal& ours, std::ostream* out) {
  TextTable table;
  table.title = "Table 5.2, " + std::string(theirs.name) + ": vibration, g; ours in five stretches of 12 s";
  table.corner = "specimen, stretch";
  table.columns = {"rms", "thesis", "pk-pk", "thesis"};
  const size_t length = ours.size() / stretches;
  for (size_t i = 0; i < stretches; ++i) {
    const auto part = std::span(ours).subspan(i * length, length);
    table.lines.push_back(
        {std::to_string(i + 1),
         {root_mean_square(part), theirs.g_rms[i], peak_to_peak(part, length)[0], theirs.peak_g[i]}});
  }
  table.print(out, 3);
}

void plot(const PublishedVibration& theirs, const Signal& ours, Plots& plots) {
  const size_t length = ours.size() / stretches;
  const std::string spectrum = "fig-5-" + std::to_string(theirs.periodogram_figure);
  std::vector<std::vector<double>> rows(periodogram(std::span(ours).first(length)).size());
  for (size_t hz = 0; hz < rows.size(); ++hz) rows[hz].push_back(static_cast<double>(hz + 1));
  for (size_t i = 0; i < stretches; ++i) {
    const auto power = periodogram(std::span(ours).subspan(i * length, length));
    for (size_t hz = 0; hz < rows.size(); ++hz) rows[hz].push_back(10.0 * std::log10(power[hz]));
  }
  plots.data(spectrum, "frequency_hz db1 db2 db3 db4 db5 (g^2/Hz)", rows);
  std::ostringstream commands;
  commands << "set title 'Periodogram, " << theirs.name << " bone, five stretches of 12 s (fig. 5."
           << theirs.periodogram_figure << ")'\nset xlabel 'frequency, Hz'\nset ylabel 'power, dB (g^2/Hz)'\n"
           << "set key bottom right\nplot for [i=2:6] '" << spectrum
           << ".dat' using 1:i with lines lw 0.8 title sprintf('stretch %d', i - 1)";
  plots.script(spectrum, commands.str());

  const std::string sample = "fig-5-" + std::to_string(theirs.sample_figure);
  std::vector<std::vector<double>> samples;
  for (size_t i = 0; i < window_ticks; ++i) samples.push_back({static_cast<double>(i) * tick_s, ours[i]});
  plots.data(sample, "t_s g", samples);
  plots.script(sample,
               std::string("set title 'Vibration signal, ") + theirs.name + " bone, 1 kHz (fig. 5." +
                   std::to_string(theirs.sample_figure) +
                   ")'\nset xlabel 'time, s'\nset ylabel 'acceleration, g'\nset yrange [-4:4]\nplot '" +
                   sample + ".dat' using 1:2 with lines lw 0.6 notitle");
}

}  // namespace

std::vector<Row> vibration_rows(const Options& options, Plots& plots) {
  const auto tracks = force::make_vibration_tracks({}, seed);
  std::vector<Row> rows;
  for (const PublishedVibration& theirs : published) {
    const Signal ours = minute_of(tracks, theirs.bone_class);
    const auto windows = peak_to_peak(ours, window_ticks);
    const std::string name = std::string("vibration, ") + theirs.name + ", a minute, ";
    const double g_rms = root_mean_square(ours);
    rows.push_back({"validate", name + "g_rms", g_rms, theirs.mean_g_rms.mean, "g", 0.0});
    rows.push_back({"validate", name + "g_rms off the published", percent_off(g_rms, theirs.mean_g_rms.mean),
                    0.0, "%", strength_goal_percent});
    rows.push_back({"validate", name + "peak to peak of 5 s, mean", statistics::mean_of(windows),
                    theirs.mean_peak_g.mean, "g", 0.0});
    rows.push_back({"validate", name + "peak to peak of 5 s, mean off the published",
                    percent_off(statistics::mean_of(windows), theirs.mean_peak_g.mean), 0.0, "%",
                    strength_goal_percent});
    rows.push_back({"validate", name + "peak to peak of 5 s, farthest off, in published deviations",
                    worst_window(theirs, windows), 0.0, "", peak_goal_deviations});
    rows.push_back({"validate", name + "strongest frequency over those around it",
                    line_strength(periodogram(ours)), 0.0, "", line_goal});
    print_table(theirs, ours, options.tables);
    plot(theirs, ours, plots);
  }
  return rows;
}

}  // namespace ream::bench
