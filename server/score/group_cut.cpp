#include "score/group_cut.hpp"

#include <cmath>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "score/group_density.hpp"

namespace ream::score {
namespace {

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

}  // namespace ream::score
