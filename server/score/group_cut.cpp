#include "score/group_cut.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "statistics/sample.hpp"

namespace ream::score {
using nlohmann::json;
using statistics::quantile;
using statistics::Spread;
using statistics::spread_of;
namespace {

double silverman_width(std::vector<double> values, double sd) {
  std::sort(values.begin(), values.end());
  const double iqr = quantile(values, 0.75) - quantile(values, 0.25);
  const double scale = iqr > 0.0 ? std::min(sd, iqr / 1.34) : sd;
  return 0.9 * scale * std::pow(static_cast<double>(values.size()), -0.2);
}

/// Density of one group of values; see Density for both kinds.
class GroupDensity {
 public:
  /// At least two values that are not all equal.
  GroupDensity(std::span<const double> values, Density kind);

  double at(double x) const;
  /// Share of the group below x.
  double below(double x) const;

 private:
  std::vector<double> centres_;
  double width_ = 1.0;  ///< standard deviation of the normal around each centre
};

GroupDensity::GroupDensity(std::span<const double> values, Density kind) {
  const Spread spread = spread_of(values);
  if (kind == Density::normal) {
    centres_ = {spread.mean};
    width_ = spread.sd;
  } else {
    centres_.assign(values.begin(), values.end());
    width_ = silverman_width(centres_, spread.sd);
  }
}

double GroupDensity::at(double x) const {
  double sum = 0.0;
  for (const double centre : centres_) {
    const double z = (x - centre) / width_;
    sum += std::exp(-0.5 * z * z);
  }
  return sum / (static_cast<double>(centres_.size()) * width_ * std::sqrt(2.0 * std::numbers::pi));
}

double GroupDensity::below(double x) const {
  double sum = 0.0;
  for (const double centre : centres_) sum += 0.5 * std::erfc((centre - x) / (width_ * std::numbers::sqrt2));
  return sum / static_cast<double>(centres_.size());
}

constexpr int scan_steps = 4096;
constexpr int bisections = 60;

Spread checked_spread(std::span<const double> values, const char* group) {
  if (values.size() < 3)
    throw Error(ErrorKind::invalid_input, std::string("contrasting groups: there are ") +
                                              std::to_string(values.size()) + " " + group +
                                              ", at least 3 are needed");
  const Spread spread = spread_of(values);
  if (!std::isfinite(spread.mean) || !std::isfinite(spread.sd))
    throw Error(ErrorKind::invalid_input,
                std::string("contrasting groups: a value of the ") + group + " is not finite");
  if (!(spread.sd > 0.0))
    throw Error(ErrorKind::invalid_input, std::string("contrasting groups: all ") + group +
                                              " have the same value, which has no density");
  return spread;
}

/// Densities of both groups, and what they say of a cut.
struct Groups {
  GroupDensity novices, experts;
  bool experts_higher = true;

  double difference(double x) const { return experts.at(x) - novices.at(x); }
  double novices_passing(double cut) const {
    return experts_higher ? 1.0 - novices.below(cut) : novices.below(cut);
  }
  double experts_failing(double cut) const {
    return experts_higher ? experts.below(cut) : 1.0 - experts.below(cut);
  }
};

/// Where the difference changes its sign between a and b.
double crossing(const Groups& groups, double a, double b) {
  const bool positive = groups.difference(a) > 0.0;
  for (int i = 0; i < bisections; ++i) {
    const double middle = 0.5 * (a + b);
    ((groups.difference(middle) > 0.0) == positive ? a : b) = middle;
  }
  return 0.5 * (a + b);
}

/// From the novices' side to the experts' side; of several, the one with the fewest on the wrong side.
std::optional<double> best_crossing(const Groups& groups, double novice_mean, double expert_mean) {
  std::optional<double> best;
  double best_wrong = 0.0;
  double before = novice_mean;
  for (int i = 1; i <= scan_steps; ++i) {
    const double here = novice_mean + (expert_mean - novice_mean) * i / scan_steps;
    if (groups.difference(before) <= 0.0 && groups.difference(here) > 0.0) {
      const double cut = crossing(groups, before, here);
      const double wrong = groups.novices_passing(cut) + groups.experts_failing(cut);
      if (!best || wrong < best_wrong) {
        best = cut;
        best_wrong = wrong;
      }
    }
    before = here;
  }
  return best;
}

using Value = std::function<std::optional<double>(const EndedSession&)>;

std::vector<double> values_in(const std::vector<EndedSession>& sessions, const Value& value) {
  std::vector<double> values;
  for (const EndedSession& session : sessions)
    if (const auto number = value(session)) values.push_back(*number);
  return values;
}

json cut_json(const std::string& of, const std::vector<double>& novices, const std::vector<double>& experts,
              Density density) {
  try {
    const GroupCut cut = contrasting_groups(novices, experts, density);
    return {{"of", of},
            {"density", to_text(cut.density)},
            {"cut", cut.cut},
            {"experts_higher", cut.experts_higher},
            {"novices", cut.novices},
            {"novice_mean", cut.novice_mean},
            {"novice_sd", cut.novice_sd},
            {"novices_passing", cut.novices_passing},
            {"expected_novices_passing", cut.expected_novices_passing},
            {"experts", cut.experts},
            {"expert_mean", cut.expert_mean},
            {"expert_sd", cut.expert_sd},
            {"experts_failing", cut.experts_failing},
            {"expected_experts_failing", cut.expected_experts_failing}};
  } catch (const Error& e) {
    return {{"of", of}, {"error", e.what()}};
  }
}

}  // namespace

GroupCut contrasting_groups(std::span<const double> novices, std::span<const double> experts,
                            Density density) {
  const Spread novice = checked_spread(novices, "novices"), expert = checked_spread(experts, "experts");
  const Groups groups{{novices, density}, {experts, density}, expert.mean > novice.mean};
  const std::optional<double> cut = best_crossing(groups, novice.mean, expert.mean);
  if (!cut)
    throw Error(
        ErrorKind::invalid_input,
        "contrasting groups: the densities of novices and experts do not cross between their means; the "
        "groups are not told apart by this value");
  GroupCut result;
  result.density = density;
  result.cut = *cut;
  result.experts_higher = groups.experts_higher;
  result.novice_mean = novice.mean;
  result.novice_sd = novice.sd;
  result.expert_mean = expert.mean;
  result.expert_sd = expert.sd;
  result.novices = static_cast<int>(novices.size());
  result.experts = static_cast<int>(experts.size());
  for (const double value : novices) result.novices_passing += result.passes(value) ? 1 : 0;
  for (const double value : experts) result.experts_failing += result.passes(value) ? 0 : 1;
  result.expected_novices_passing = groups.novices_passing(*cut);
  result.expected_experts_failing = groups.experts_failing(*cut);
  return result;
}

std::string_view to_text(Density density) { return density == Density::normal ? "normal" : "kernel"; }

json group_cuts_json(const std::vector<EndedSession>& novices, const std::vector<EndedSession>& experts,
                     const Rubric& rubric, Density density) {
  const Value points = [&](const EndedSession& session) {
    return apply_rubric(rubric, session.metrics).points;
  };
  json cuts =
      json::array({cut_json("points", values_in(novices, points), values_in(experts, points), density)});
  for (const Metric& metric : metric_catalogue()) {
    if (!aim_of(metric)) continue;
    const std::string key(metric.key);
    const Value value = [&](const EndedSession& session) { return session.value(key); };
    const auto of_novices = values_in(novices, value), of_experts = values_in(experts, value);
    if (!of_novices.empty() && !of_experts.empty())
      cuts.push_back(cut_json(key, of_novices, of_experts, density));
  }
  return cuts;
}

Density density_from_text(const std::string& text) {
  for (const Density density : {Density::normal, Density::kernel})
    if (text == to_text(density)) return density;
  throw Error(ErrorKind::invalid_input, "density '" + text + "' is neither normal nor kernel");
}

}  // namespace ream::score
