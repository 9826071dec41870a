#include <array>
#include <cmath>
#include <vector>

#include "bench/text_table.hpp"
#include "bench/validate/normal_noise.hpp"
#include "bench/validate/parallel.hpp"
#include "bench/validate/protocol.hpp"
#include "bench/validate/validate_parts.hpp"
#include "statistics/distributions.hpp"
#include "statistics/sample.hpp"

namespace ream::bench {
namespace {

constexpr size_t experiments = 8, reamed_specimens = 6;
constexpr uint64_t scatter_seed = 5201;

/// One experiment on six specimens, with forces as the published ones scatter.
struct Experiment {
  std::array<double, reamed_specimens> cortical_n, cancellous_n, cortical_mm_s, cancellous_mm_s;
};

void ream_specimen(size_t s, const PhaseForces& forces, Experiment& experiment) {
  const SpecimenRun run = run_protocol(s, forces);
  experiment.cortical_n[s] = run.cortical.held_thrust_n;
  experiment.cancellous_n[s] = run.cancellous.held_thrust_n;
  experiment.cortical_mm_s[s] = run.cortical.held_feed_mm_s;
  experiment.cancellous_mm_s[s] = run.cancellous.held_feed_mm_s;
}

/// A figure of every experiment, and how far the published one lies from their mean: in half widths of the
/// interval that holds 95 % of such experiments.
struct Repeated {
  std::vector<double> values;

  double half_width() const {
    return statistics::t_quantile(0.975, static_cast<double>(values.size() - 1)) *
           statistics::spread_of(values).sd * std::sqrt(1.0 + 1.0 / static_cast<double>(values.size()));
  }
  double off(double published) const {
    return std::abs(statistics::mean_of(values) - published) / half_width();
  }
};

void add_bone(const PublishedBone& bone, const std::vector<Experiment>& all,
              std::array<double, reamed_specimens> Experiment::*thrust,
              std::array<double, reamed_specimens> Experiment::*feed, const Options& options,
              std::vector<Row>& rows) {
  Repeated thrust_n, thrust_deviation_n, feed_mm_s, feed_deviation_mm_s;
  for (const Experiment& experiment : all) {
    thrust_n.values.push_back(statistics::mean_of(experiment.*thrust));
    thrust_deviation_n.values.push_back(statistics::spread_of(experiment.*thrust).sd);
    feed_mm_s.values.push_back(statistics::mean_of(experiment.*feed));
    feed_deviation_mm_s.values.push_back(statistics::spread_of(experiment.*feed).sd);
  }
  TextTable table;
  table.title = "Robot whose force scatters, " + std::string(bone.name) + ": eight experiments on six";
  table.corner = "over six specimens";
  table.columns = {"ours", "95 % +-", "thesis"};
  const std::string name = std::string("robot, force scatters, ") + bone.name;
  const auto row = [&](const char* what, const Repeated& ours, double theirs) {
    table.lines.push_back({what, {statistics::mean_of(ours.values), ours.half_width(), theirs}});
    constexpr double goal = 1.0;
    rows.push_back(
        {"validate", name + ", " + what + " off, in 95 % intervals", ours.off(theirs), 0.0, "", goal});
  };
  row("held thrust, N", thrust_n, bone.thrust_n.mean);
  row("its deviation, N", thrust_deviation_n, bone.thrust_n.deviation);
  row("feed, mm/s", feed_mm_s, bone.feed_mm_s.mean);
  row("its deviation, mm/s", feed_deviation_mm_s, bone.feed_mm_s.deviation);
  table.print(options.tables, 4);
}

}  // namespace

std::vector<Row> scatter_rows(const Options& options) {
  NormalNoise noise(scatter_seed);
  const auto drawn = [&](const MeanAndDeviation& published) {
    return published.mean + published.deviation * noise.normal();
  };
  std::vector<PhaseForces> forces;
  for (size_t i = 0; i < experiments * reamed_specimens; ++i) {
    const double cortical_n = drawn(published_cortical.thrust_n);
    forces.push_back({cortical_n, drawn(published_cancellous.thrust_n)});
  }
  std::vector<Experiment> all(experiments);
  in_parallel(forces.size(),
              [&](size_t i) { ream_specimen(i % reamed_specimens, forces[i], all[i / reamed_specimens]); });
  std::vector<Row> rows;
  add_bone(published_cortical, all, &Experiment::cortical_n, &Experiment::cortical_mm_s, options, rows);
  add_bone(published_cancellous, all, &Experiment::cancellous_n, &Experiment::cancellous_mm_s, options, rows);
  return rows;
}

}  // namespace ream::bench
