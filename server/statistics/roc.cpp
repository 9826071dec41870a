#include "statistics/roc.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "statistics/distributions.hpp"
#include "statistics/proportion.hpp"
#include "statistics/sample.hpp"

namespace ream::statistics {
namespace {

/// Each value's place among all different values, and their number.
struct Places {
  std::vector<size_t> group, others;
  std::vector<double> values;
};

Places places_of(std::span<const double> group, std::span<const double> others) {
  Places places;
  places.values.assign(group.begin(), group.end());
  places.values.insert(places.values.end(), others.begin(), others.end());
  std::sort(places.values.begin(), places.values.end());
  places.values.erase(std::unique(places.values.begin(), places.values.end()), places.values.end());
  const auto place = [&](double value) {
    return static_cast<size_t>(std::lower_bound(places.values.begin(), places.values.end(), value) -
                               places.values.begin());
  };
  for (const double value : group) places.group.push_back(place(value));
  for (const double value : others) places.others.push_back(place(value));
  return places;
}

/// How many of each place.
std::vector<uint64_t> counts_of(const std::vector<size_t>& places, size_t size) {
  std::vector<uint64_t> counts(size, 0);
  for (const size_t place : places) ++counts[place];
  return counts;
}

double area_of(const std::vector<uint64_t>& group, const std::vector<uint64_t>& others) {
  uint64_t below = 0, all = 0, twice = 0;
  for (size_t i = 0; i < group.size(); ++i) {
    twice += group[i] * (2 * below + others[i]);
    below += others[i];
    all += group[i];
  }
  return 0.5 * static_cast<double>(twice) / (static_cast<double>(all) * static_cast<double>(below));
}

/// For each place of `own`, the share of `other` that lies below it, ties half.
std::vector<double> shares_below(const std::vector<size_t>& own, const std::vector<uint64_t>& other) {
  std::vector<uint64_t> twice_below(other.size(), 0);
  uint64_t below = 0;
  for (size_t i = 0; i < other.size(); ++i) {
    twice_below[i] = 2 * below + other[i];
    below += other[i];
  }
  std::vector<double> shares;
  shares.reserve(own.size());
  for (const size_t place : own)
    shares.push_back(0.5 * static_cast<double>(twice_below[place]) / static_cast<double>(below));
  return shares;
}

/// A number below `end` of which each is as likely, the same on every machine.
size_t drawn_below(size_t end, std::mt19937_64& random) {
  const uint64_t whole = std::mt19937_64::max() - std::mt19937_64::max() % end;
  uint64_t number = random();
  while (number >= whole) number = random();
  return static_cast<size_t>(number % end);
}

std::vector<uint64_t> drawn_again(const std::vector<size_t>& places, size_t size, std::mt19937_64& random) {
  std::vector<uint64_t> counts(size, 0);
  for (size_t i = 0; i < places.size(); ++i) ++counts[places[drawn_below(places.size(), random)]];
  return counts;
}

Interval bootstrap_interval(const Places& places, const Bootstrap& bootstrap, double tail) {
  std::mt19937_64 random(bootstrap.seed);
  std::vector<double> areas;
  for (size_t i = 0; i < bootstrap.samples; ++i) {
    const auto group = drawn_again(places.group, places.values.size(), random);
    areas.push_back(area_of(group, drawn_again(places.others, places.values.size(), random)));
  }
  std::sort(areas.begin(), areas.end());
  return {quantile(areas, tail), quantile(areas, 1.0 - tail)};
}

BestCut best_cut(const Places& places, bool at_least, double confidence) {
  const auto group = counts_of(places.group, places.values.size());
  const auto others = counts_of(places.others, places.values.size());
  const auto m = static_cast<int64_t>(places.group.size()), n = static_cast<int64_t>(places.others.size());
  int64_t group_below = 0, others_below = 0, best = -1, best_hits = 0, best_rejected = 0;
  BestCut cut;
  cut.at_least = at_least;
  for (size_t i = 0; i < places.values.size(); ++i) {
    const int64_t own = static_cast<int64_t>(group[i]), foreign = static_cast<int64_t>(others[i]);
    const int64_t hits = at_least ? m - group_below : group_below + own;
    const int64_t rejected = at_least ? others_below : n - others_below - foreign;
    if (const int64_t worth = hits * n + rejected * m; worth > best) {
      best = worth;
      best_hits = hits;
      best_rejected = rejected;
      cut.threshold = places.values[i];
    }
    group_below += own;
    others_below += foreign;
  }
  cut.sensitivity = static_cast<double>(best_hits) / static_cast<double>(m);
  cut.specificity = static_cast<double>(best_rejected) / static_cast<double>(n);
  cut.youden_j = cut.sensitivity + cut.specificity - 1.0;
  cut.sensitivity_interval = wilson_interval(static_cast<size_t>(best_hits), places.group.size(), confidence);
  cut.specificity_interval =
      wilson_interval(static_cast<size_t>(best_rejected), places.others.size(), confidence);
  return cut;
}

/// DeLong's interval, and the bootstrap's; a sentence where one of them cannot be had.
std::string add_intervals(RocArea& roc, const Places& places, const Bootstrap& bootstrap, double tail) {
  const double above =
      spread_of(shares_below(places.group, counts_of(places.others, places.values.size()))).sd;
  const double below =
      spread_of(shares_below(places.others, counts_of(places.group, places.values.size()))).sd;
  const double variance =
      above * above / static_cast<double>(roc.group) + below * below / static_cast<double>(roc.others);
  if (variance <= 0.0)
    return "the groups do not overlap, or all values are equal, so that the area has no interval";
  roc.standard_error = std::sqrt(variance);
  const double reach = normal_quantile(1.0 - tail) * *roc.standard_error;
  roc.interval = Interval{std::max(0.0, roc.area - reach), std::min(1.0, roc.area + reach)};
  if (std::min(roc.group, roc.others) < bootstrap.least_group)
    return "the bootstrap needs " + std::to_string(bootstrap.least_group) + " values or more in each group";
  roc.bootstrap = bootstrap_interval(places, bootstrap, tail);
  return "";
}

}  // namespace

Answer<RocArea> roc_area(std::span<const double> group, std::span<const double> others,
                         const Bootstrap& bootstrap, double confidence) {
  const double tail = tail_of(confidence);
  if (group.size() < 2 || others.size() < 2)
    return {std::nullopt, "a ROC curve needs two values or more in each group"};
  const Places places = places_of(group, others);
  RocArea roc;
  roc.group = group.size();
  roc.others = others.size();
  roc.area =
      area_of(counts_of(places.group, places.values.size()), counts_of(places.others, places.values.size()));
  roc.cut = best_cut(places, roc.area >= 0.5, confidence);
  std::string note = add_intervals(roc, places, bootstrap, tail);
  return {roc, std::move(note)};
}

}  // namespace ream::statistics
