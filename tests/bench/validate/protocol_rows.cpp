#include <cmath>
#include <limits>
#include <sstream>

#include "bench/text_table.hpp"
#include "bench/validate/parallel.hpp"
#include "bench/validate/protocol.hpp"
#include "bench/validate/validate_parts.hpp"
#include "core/clock.hpp"
#include "statistics/sample.hpp"

namespace ream::bench {
namespace {

constexpr size_t protocol_specimens = 6;
/// Of the ideal device's coupling, through which a handle that advances feels the bone. The experiments'
/// robot and fixture gave way too, by how much is not published.
constexpr double handle_spring_n_mm = 100.0;
using Phases = std::array<Phase, protocol_specimens>;

/// Twenty times a second, as long as all six ream: time, mean and deviation of thrust, then of advance; from
/// the moment of full force on also what the thesis gives: thrust, and advance at its feed.
std::vector<std::vector<double>> curves(const PublishedBone& bone, const Phases& phases) {
  constexpr size_t every_ticks = 50;
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  size_t shortest = phases[0].ticks.size();
  for (const Phase& phase : phases) shortest = std::min(shortest, phase.ticks.size());
  std::vector<std::vector<double>> rows;
  double held_since_s = 0.0, held_from_mm = nothing;
  for (size_t i = 0; i < shortest; i += every_ticks) {
    std::array<double, protocol_specimens> thrust, advance;
    for (size_t s = 0; s < protocol_specimens; ++s) {
      thrust[s] = phases[s].ticks[i].thrust_n;
      advance[s] = phases[s].ticks[i].advance_mm;
    }
    const double t_s = static_cast<double>(i) * tick_s;
    const bool held = statistics::mean_of(thrust) > 0.999 * published_thrust_n;
    if (held && std::isnan(held_from_mm)) {
      held_since_s = t_s;
      held_from_mm = statistics::mean_of(advance);
    }
    rows.push_back({t_s, statistics::mean_of(thrust), statistics::spread_of(thrust).sd,
                    statistics::mean_of(advance), statistics::spread_of(advance).sd,
                    held ? bone.thrust_n.mean : nothing,
                    held_from_mm + bone.feed_mm_s.mean * (t_s - held_since_s)});
  }
  return rows;
}

/// Figure 5.2 or 5.3.
void plot(const PublishedBone& bone, const Phases& phases, Plots& plots) {
  const std::string name = "fig-5-" + std::to_string(bone.thrust_figure);
  plots.data(name, "t_s thrust_n deviation_n advance_mm deviation_mm thesis_thrust_n thesis_advance_mm",
             curves(bone, phases));
  std::ostringstream text;
  text << "set title 'Thrust and displacement, " << bone.name << " bone, mean and deviation of six (fig. 5."
       << bone.thrust_figure << ")'\n"
       << "set xlabel 'time since contact, s'\nset ylabel 'thrust, N'\nset y2label 'displacement, mm'\n"
       << "set ytics nomirror\nset y2tics\nset yrange [0:80]\nset y2range [0:*]\nset key top left\n"
       << "set style fill transparent solid 0.2 noborder\nset datafile missing 'nan'\nf = '" << name
       << ".dat'\nb = '#1f77b4'\nr = '#d62728'\nd = " << bone.thrust_n.deviation << "\n"
       << "plot f using 1:($6-d):($6+d) with filledcurves lc rgb b title 'thesis, held thrust, deviation', "
       << "f using 1:6 with lines lw 2 dt 2 lc rgb b title 'thesis, held thrust', "
       << "f using 1:($2-$3):($2+$3) with filledcurves lc rgb b notitle, "
       << "f using 1:2 with lines lw 2 lc rgb b title 'ours, thrust', "
       << "f using 1:($4-$5):($4+$5) axes x1y2 with filledcurves lc rgb r title 'ours, displacement, "
          "deviation', "
       << "f using 1:4 axes x1y2 with lines lw 2 lc rgb r title 'ours, displacement', "
       << "f using 1:7 axes x1y2 with lines lw 2 dt 2 lc rgb r title 'at the feed of the thesis'";
  plots.script(name, text.str());
}

std::vector<Row> rows_of(const PublishedBone& bone, const Phases& phases, const Options& options) {
  std::array<double, protocol_specimens> thrust, feed;
  TextTable stiffness;
  stiffness.title = "Apparent machining stiffness, " + std::string(bone.name) +
                    ", N/mm: thrust gained per mm of the tool's advance (and of a handle's\nbefore a spring "
                    "of 100 N/mm) on the way to 90 % of 52 N";
  stiffness.corner = "specimen";
  stiffness.columns = {"ours", "at the handle", "thesis"};
  for (size_t s = 0; s < protocol_specimens; ++s) {
    thrust[s] = phases[s].held_thrust_n;
    feed[s] = phases[s].held_feed_mm_s;
    const double ours = phases[s].stiffness_n_mm;
    stiffness.lines.push_back(
        {std::to_string(s + 1),
         {ours, ours * handle_spring_n_mm / (ours + handle_spring_n_mm), bone.specimens[s].stiffness_n_mm}});
  }
  stiffness.print(options.tables, 1);
  const std::string name = std::string("robot protocol, ") + bone.name;
  return {
      {"validate", name + ", held thrust, mean of six", statistics::mean_of(thrust), bone.thrust_n.mean, "N",
       0.0},
      {"validate", name + ", held thrust, deviation", statistics::spread_of(thrust).sd,
       bone.thrust_n.deviation, "N", 0.0},
      {"validate", name + ", feed, mean of six", statistics::mean_of(feed), bone.feed_mm_s.mean, "mm/s", 0.0},
      {"validate", name + ", feed, deviation", statistics::spread_of(feed).sd, bone.feed_mm_s.deviation,
       "mm/s", 0.0}};
}

}  // namespace

std::vector<Row> protocol_rows(const Options& options, Plots& plots) {
  Phases cortical, cancellous;
  in_parallel(protocol_specimens, [&](size_t s) {
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
