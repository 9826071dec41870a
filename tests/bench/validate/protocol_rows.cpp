#include <sstream>

#include "bench/text_table.hpp"
#include "bench/validate/parallel.hpp"
#include "bench/validate/protocol.hpp"
#include "bench/validate/statistics.hpp"
#include "bench/validate/validate_parts.hpp"
#include "core/clock.hpp"

namespace ream::bench {
namespace {

constexpr size_t specimens = 6;
using Phases = std::array<Phase, specimens>;

/// Means and deviations over the specimens, 20 times a second, as long as all six ream.
std::vector<std::vector<double>> curve(const Phases& phases) {
  constexpr size_t every_ticks = 50;
  size_t shortest = phases[0].ticks.size();
  for (const Phase& phase : phases) shortest = std::min(shortest, phase.ticks.size());
  std::vector<std::vector<double>> rows;
  for (size_t i = 0; i < shortest; i += every_ticks) {
    std::array<double, specimens> thrust, advance;
    for (size_t s = 0; s < specimens; ++s) {
      thrust[s] = phases[s].ticks[i].thrust_n;
      advance[s] = phases[s].ticks[i].advance_mm;
    }
    rows.push_back({static_cast<double>(i) * tick_s, mean(thrust), deviation(thrust), mean(advance),
                    deviation(advance)});
  }
  return rows;
}

/// Figure 5.2 or 5.3.
void plot(const PublishedBone& bone, const Phases& phases, Plots& plots) {
  const std::string name = "fig-5-" + std::to_string(bone.thrust_figure);
  plots.data(name, "t_s thrust_n deviation_n advance_mm deviation_mm", curve(phases));
  std::ostringstream commands;
  commands << "set title 'Thrust and displacement, " << bone.name
           << " bone, mean and deviation of six (fig. 5." << bone.thrust_figure
           << ")'\nset xlabel 'time since contact, s'\nset ylabel 'thrust, N'\n"
           << "set y2label 'displacement, mm'\nset ytics nomirror\nset y2tics\nset yrange [0:70]\n"
           << "set y2range [0:*]\nset key top left\nset style fill transparent solid 0.25 noborder\nf = '"
           << name << ".dat'\nplot f using 1:($2-$3):($2+$3) with filledcurves lc rgb '#1f77b4' notitle, "
           << "f using 1:2 with lines lw 2 lc rgb '#1f77b4' title 'thrust, ours', " << bone.thrust_n.mean
           << " with lines dt 2 lc rgb '#1f77b4' title 'thesis, held thrust', "
           << "f using 1:($4-$5):($4+$5) axes x1y2 with filledcurves lc rgb '#d62728' notitle, "
           << "f using 1:4 axes x1y2 with lines lw 2 lc rgb '#d62728' title 'displacement, ours'";
  plots.script(name, commands.str());
}

std::vector<Row> rows_of(const PublishedBone& bone, const Phases& phases, const Options& options) {
  std::array<double, specimens> thrust, feed;
  TextTable stiffness;
  stiffness.title = "Apparent machining stiffness, " + std::string(bone.name) +
                    ", N/mm: thrust gained per mm of the tool's advance on the way to 90 % of 52 N";
  stiffness.corner = "specimen";
  stiffness.columns = {"ours", "thesis"};
  for (size_t s = 0; s < specimens; ++s) {
    thrust[s] = phases[s].held_thrust_n;
    feed[s] = phases[s].held_feed_mm_s;
    stiffness.lines.push_back(
        {std::to_string(s + 1), {phases[s].stiffness_n_mm, bone.specimens[s].stiffness_n_mm}});
  }
  stiffness.print(options.tables, 1);
  const std::string name = std::string("robot protocol, ") + bone.name;
  return {
      {"validate", name + ", held thrust, mean of six", mean(thrust), bone.thrust_n.mean, "N", 0.0},
      {"validate", name + ", held thrust, deviation", deviation(thrust), bone.thrust_n.deviation, "N", 0.0},
      {"validate", name + ", feed, mean of six", mean(feed), bone.feed_mm_s.mean, "mm/s", 0.0},
      {"validate", name + ", feed, deviation", deviation(feed), bone.feed_mm_s.deviation, "mm/s", 0.0}};
}

}  // namespace

std::vector<Row> protocol_rows(const Options& options, Plots& plots) {
  Phases cortical, cancellous;
  in_parallel(specimens, [&](size_t s) {
    SpecimenRun run = run_protocol(s);
    cortical[s] = std::move(run.cortical);
    cancellous[s] = std::move(run.cancellous);
  });
  std::vector<Row> rows = rows_of(published_cortical, cortical, options);
  for (Row& row : rows_of(published_cancellous, cancellous, options)) rows.push_back(std::move(row));
  plot(published_cortical, cortical, plots);
  plot(published_cancellous, cancellous, plots);
  return rows;
}

}  // namespace ream::bench
