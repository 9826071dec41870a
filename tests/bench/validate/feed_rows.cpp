#include <cmath>
#include <sstream>

#include "bench/text_table.hpp"
#include "bench/validate/parallel.hpp"
#include "bench/validate/prediction_interval.hpp"
#include "bench/validate/steady_reaming.hpp"
#include "bench/validate/validate_parts.hpp"
#include "statistics/regression.hpp"

namespace ream::bench {
namespace {

constexpr size_t specimens = 6;
constexpr std::array thrusts_n{20.0, 35.0, 52.0, 78.0};
constexpr size_t reference_thrust = 2;  ///< index of 52 N
constexpr double feed_goal_percent = 2.0, regression_goal_percent = 2.0;

/// Simulated feeds of the six specimens of one bone, mm/s.
struct Feeds {
  double of_law[specimens][thrusts_n.size()];
  std::array<double, specimens> of_specimen;  ///< with its factor, at 52 N
};

Feeds simulate(const PublishedBone& bone) {
  Feeds feeds{};
  constexpr size_t runs_a_specimen = thrusts_n.size() + 1;
  in_parallel(specimens * runs_a_specimen, [&](size_t i) {
    const size_t s = i / runs_a_specimen, run = i % runs_a_specimen;
    const Specimen& specimen = bone.specimens[s];
    if (run < thrusts_n.size())
      feeds.of_law[s][run] = steady_reaming(specimen.density_g_cc, thrusts_n[run]).feed_mm_s;
    else
      feeds.of_specimen[s] =
          steady_reaming(specimen.density_g_cc, thrusts_n[reference_thrust], specimen_factor(bone, specimen))
              .feed_mm_s;
  });
  return feeds;
}

std::string name_of(const PublishedBone& bone, const char* what) {
  return "model thesis, " + std::string(bone.name) + what;
}

std::vector<Row> rows_of_specimens(const PublishedBone& bone, const Feeds& feeds) {
  std::vector<Row> rows;
  for (size_t s = 0; s < specimens; ++s) {
    const double density = bone.specimens[s].density_g_cc;
    double worst = 0.0;
    for (size_t k = 0; k < thrusts_n.size(); ++k) {
      const double law = thrusts_n[k] / published_thrust_n * law_mm_s(bone, density);
      worst = std::max(worst, percent_off(feeds.of_law[s][k], law));
    }
    std::ostringstream name;
    name << "model thesis, " << bone.name << " feed at " << density
         << " g/cc, worst of 20, 35, 52, 78 N, off the law";
    rows.push_back({"validate", name.str(), worst, 0.0, "%", feed_goal_percent});
  }
  return rows;
}

void add_regressions(const PublishedBone& bone, const statistics::Regression& law,
                     const statistics::Regression& specimens_, std::vector<Row>& rows) {
  const auto row = [&](const char* what, double ours, double theirs) {
    rows.push_back(
        {"validate", name_of(bone, what), percent_off(ours, theirs), 0.0, "%", regression_goal_percent});
  };
  row(" slope of feed on density, off the published", law.slope, bone.law.slope_mm_s_per_g_cc);
  row(" intercept, off the published", law.intercept, bone.law.intercept_mm_s);
  row(" with specimen factors: rho, off the published", specimens_.rho, bone.rho);
  row(" with specimen factors: R2, off the published", specimens_.r_squared, bone.r_squared);
}

void print_tables(const PublishedBone& bone, const Feeds& feeds, const statistics::Regression& law,
                  const statistics::Regression& ours, const statistics::Regression& theirs,
                  std::ostream* out) {
  TextTable table;
  table.title = "Table 5.1, " + std::string(bone.name) + ": feed rate at 52 N, mm/s";
  table.corner = "specimen";
  table.columns = {"D g/cc", "law", "ours", "factor", "ours, factor", "thesis"};
  for (size_t s = 0; s < specimens; ++s) {
    const Specimen& specimen = bone.specimens[s];
    table.lines.push_back(
        {std::to_string(s + 1),
         {specimen.density_g_cc, law_mm_s(bone, specimen.density_g_cc), feeds.of_law[s][reference_thrust],
          specimen_factor(bone, specimen), feeds.of_specimen[s], specimen.feed_mm_s}});
  }
  table.print(out, 4);
  TextTable lines;
  lines.title = "Regression of feed on density, " + std::string(bone.name);
  lines.corner = "over the six";
  lines.columns = {"slope", "intercept", "rho", "R2", "p"};
  const auto line = [&](const char* label, const statistics::Regression& r) {
    lines.lines.push_back({label, {r.slope, r.intercept, r.rho, r.r_squared, r.p}});
  };
  line("ours, law alone", law);
  line("ours, specimen factors", ours);
  line("thesis' table, regressed here", theirs);
  lines.lines.push_back(
      {"thesis' text",
       {bone.law.slope_mm_s_per_g_cc, bone.law.intercept_mm_s, bone.rho, bone.r_squared, bone.p}});
  lines.print(out, 4);
}

/// How well the thesis' own regression predicts a specimen that it has not seen, and ours beside it, which
/// has seen all six.
void print_left_out(const PublishedBone& bone, const Feeds& feeds, std::ostream* out) {
  TextTable table;
  table.title = "Leave one out, " + std::string(bone.name) +
                ": feed at 52 N by a regression on the other five, mm/s, with its 95 %\nprediction "
                "interval";
  table.corner = "specimen";
  table.columns = {"D g/cc", "thesis", "predicted", "from", "to", "ours"};
  for (size_t s = 0; s < specimens; ++s) {
    std::vector<double> density, feed;
    for (size_t other = 0; other < specimens; ++other) {
      if (other == s) continue;
      density.push_back(bone.specimens[other].density_g_cc);
      feed.push_back(bone.specimens[other].feed_mm_s);
    }
    const Specimen& left_out = bone.specimens[s];
    const Prediction predicted = prediction_95(density, feed, left_out.density_g_cc);
    table.lines.push_back({std::to_string(s + 1),
                           {left_out.density_g_cc, left_out.feed_mm_s, predicted.middle, predicted.low,
                            predicted.high, feeds.of_law[s][reference_thrust]}});
  }
  table.print(out, 4);
}

/// Figure 5.4 or 5.5.
void plot(const PublishedBone& bone, const Feeds& feeds, const statistics::Regression& ours, Plots& plots) {
  const std::string name = "fig-5-" + std::to_string(bone.density_figure);
  std::vector<std::vector<double>> rows;
  for (size_t s = 0; s < specimens; ++s)
    rows.push_back({bone.specimens[s].density_g_cc, bone.specimens[s].feed_mm_s, feeds.of_specimen[s]});
  plots.data(name, "density_g_cc thesis_mm_s ours_mm_s", rows);
  std::ostringstream commands;
  commands
      << "set title 'Feed rate and density, " << bone.name << " bone, 52 N (fig. 5." << bone.density_figure
      << ")'\nset xlabel 'density, g/cc'\nset ylabel 'feed rate, mm/s'\nset offsets graph 0.1, graph 0.1, "
         "graph 0.15, graph 0.15\n"
      << "theirs(x) = " << bone.law.slope_mm_s_per_g_cc << " * x + " << bone.law.intercept_mm_s
      << "\nours(x) = " << ours.slope << " * x + " << ours.intercept << "\nplot '" << name
      << ".dat' using 1:2 with points pt 6 ps 1.8 lc rgb '#1f77b4' title 'thesis, table 5.1', '" << name
      << ".dat' using 1:3 with points pt 7 ps 0.9 lc rgb '#d62728' title 'ours, specimen factors', theirs(x) "
         "with lines lw 2 lc rgb '#1f77b4' title 'thesis, eq. 5."
      << (bone.density_figure - 3)
      << "', ours(x) with lines lw 2 dt 2 lc rgb '#d62728' title 'ours, regression'";
  plots.script(name, commands.str());
}

}  // namespace

double percent_off(double ours, double theirs) { return 100.0 * std::abs(ours / theirs - 1.0); }

std::vector<Row> feed_rows(const Options& options, Plots& plots) {
  std::vector<Row> rows;
  for (const PublishedBone* bone : published_bones) {
    const Feeds feeds = simulate(*bone);
    std::array<double, specimens> density, theirs, law_alone;
    for (size_t s = 0; s < specimens; ++s) {
      density[s] = bone->specimens[s].density_g_cc;
      theirs[s] = bone->specimens[s].feed_mm_s;
      law_alone[s] = feeds.of_law[s][reference_thrust];
    }
    const statistics::Regression of_law = statistics::regression(density, law_alone);
    const statistics::Regression of_specimens = statistics::regression(density, feeds.of_specimen);
    for (Row& row : rows_of_specimens(*bone, feeds)) rows.push_back(std::move(row));
    add_regressions(*bone, of_law, of_specimens, rows);
    print_tables(*bone, feeds, of_law, of_specimens, statistics::regression(density, theirs), options.tables);
    print_left_out(*bone, feeds, options.tables);
    plot(*bone, feeds, of_specimens, plots);
  }
  return rows;
}

}  // namespace ream::bench
