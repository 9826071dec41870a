#include "statistics/kappa.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>

#include "core/error.hpp"
#include "statistics/distributions.hpp"

namespace ream::statistics {
namespace {

const char* const one_category = "every rating is the same, so that chance alone would agree wholly";

using Shares = std::vector<std::vector<double>>;

Shares weights_of(size_t categories, KappaWeights kind) {
  Shares weights(categories, std::vector<double>(categories, 0.0));
  for (size_t i = 0; i < categories; ++i)
    for (size_t j = 0; j < categories; ++j) {
      const double apart = std::abs(static_cast<double>(i) - static_cast<double>(j));
      const double share = apart / (static_cast<double>(categories) - 1.0);
      if (kind == KappaWeights::none) weights[i][j] = i == j ? 1.0 : 0.0;
      if (kind == KappaWeights::linear) weights[i][j] = 1.0 - share;
      if (kind == KappaWeights::quadratic) weights[i][j] = 1.0 - share * share;
    }
  return weights;
}

/// Shares of all subjects by both raters' categories, and of each rater's.
struct TwoRaters {
  Shares cell;
  std::vector<double> row, column;
  double subjects = 0.0;
};

TwoRaters two_raters(const std::vector<std::vector<size_t>>& table) {
  const size_t c = table.size();
  TwoRaters two{Shares(c, std::vector<double>(c, 0.0)), std::vector<double>(c, 0.0),
                std::vector<double>(c, 0.0), 0.0};
  for (const auto& row : table) {
    if (row.size() != c)
      throw Error(ErrorKind::invalid_input, "kappa needs a table of as many rows as columns");
    for (const size_t count : row) two.subjects += static_cast<double>(count);
  }
  for (size_t i = 0; i < c && two.subjects > 0.0; ++i)
    for (size_t j = 0; j < c; ++j) {
      two.cell[i][j] = static_cast<double>(table[i][j]) / two.subjects;
      two.row[i] += two.cell[i][j];
      two.column[j] += two.cell[i][j];
    }
  return two;
}

/// Formula 13 of Fleiss, Cohen & Everitt.
double cohen_variance(const TwoRaters& two, const Shares& weight, const Kappa& kappa) {
  const size_t c = two.row.size();
  std::vector<double> of_row(c, 0.0), of_column(c, 0.0);
  for (size_t i = 0; i < c; ++i)
    for (size_t j = 0; j < c; ++j) {
      of_row[i] += two.column[j] * weight[i][j];
      of_column[j] += two.row[i] * weight[i][j];
    }
  const double left = 1.0 - kappa.expected;
  double sum = 0.0;
  for (size_t i = 0; i < c; ++i)
    for (size_t j = 0; j < c; ++j) {
      const double term = weight[i][j] * left - (of_row[i] + of_column[j]) * (1.0 - kappa.observed);
      sum += two.cell[i][j] * term * term;
    }
  const double middle = kappa.observed * kappa.expected - 2.0 * kappa.expected + kappa.observed;
  return (sum - middle * middle) / (two.subjects * std::pow(left, 4.0));
}

Answer<Kappa> with_interval(Kappa kappa, double variance, double reach_in_errors) {
  if (variance <= 1e-15) return {kappa, "agreement does not vary between subjects, which has no interval"};
  kappa.standard_error = std::sqrt(variance);
  const double reach = reach_in_errors * *kappa.standard_error;
  kappa.interval = Interval{std::max(-1.0, kappa.kappa - reach), std::min(1.0, kappa.kappa + reach)};
  return {kappa, ""};
}

double raters_of(const std::vector<std::vector<size_t>>& counts) {
  size_t raters = 0;
  for (size_t i = 0; i < counts.size(); ++i) {
    const size_t here = std::accumulate(counts[i].begin(), counts[i].end(), size_t{0});
    if (i > 0 && (here != raters || counts[i].size() != counts.front().size()))
      throw Error(ErrorKind::invalid_input,
                  "Fleiss' kappa needs as many raters and categories for every subject");
    raters = here;
  }
  return static_cast<double>(raters);
}

}  // namespace

Answer<Kappa> cohens_kappa(const std::vector<std::vector<size_t>>& table, KappaWeights weights,
                           double confidence) {
  const double tail = tail_of(confidence);
  if (table.size() < 2) throw Error(ErrorKind::invalid_input, "kappa needs two categories or more");
  const TwoRaters two = two_raters(table);
  if (two.subjects < 2.0) return {std::nullopt, "agreement needs two subjects or more that both have rated"};
  const Shares weight = weights_of(table.size(), weights);
  Kappa kappa;
  kappa.subjects = static_cast<size_t>(two.subjects);
  for (size_t i = 0; i < table.size(); ++i)
    for (size_t j = 0; j < table.size(); ++j) {
      kappa.observed += weight[i][j] * two.cell[i][j];
      kappa.expected += weight[i][j] * two.row[i] * two.column[j];
    }
  if (1.0 - kappa.expected < 1e-12) return {std::nullopt, one_category};
  kappa.kappa = (kappa.observed - kappa.expected) / (1.0 - kappa.expected);
  return with_interval(kappa, cohen_variance(two, weight, kappa), normal_quantile(1.0 - tail));
}

Answer<Kappa> fleiss_kappa(const std::vector<std::vector<size_t>>& counts, double confidence) {
  const double tail = tail_of(confidence);
  const double raters = raters_of(counts);
  if (counts.size() < 2) return {std::nullopt, "agreement needs two subjects or more that all have rated"};
  if (raters < 2.0) return {std::nullopt, "agreement needs two raters or more"};
  const double n = static_cast<double>(counts.size());
  std::vector<double> share(counts.front().size(), 0.0), agreed, by_chance;
  for (const auto& row : counts)
    for (size_t j = 0; j < share.size(); ++j) share[j] += static_cast<double>(row[j]) / (n * raters);
  Kappa kappa;
  kappa.subjects = counts.size();
  for (const double p : share) kappa.expected += p * p;
  for (const auto& row : counts) {
    double pairs = 0.0, chance = 0.0;
    for (size_t j = 0; j < share.size(); ++j) {
      const double r = static_cast<double>(row[j]);
      pairs += r * (r - 1.0) / (raters * (raters - 1.0));
      chance += share[j] * r / raters;
    }
    agreed.push_back(pairs);
    by_chance.push_back(chance);
    kappa.observed += pairs / n;
  }
  const double left = 1.0 - kappa.expected;
  if (left < 1e-12) return {std::nullopt, one_category};
  kappa.kappa = (kappa.observed - kappa.expected) / left;
  double squares = 0.0;
  for (size_t i = 0; i < counts.size(); ++i) {
    const double of_subject = (agreed[i] - kappa.expected) / left -
                              2.0 * (1.0 - kappa.kappa) * (by_chance[i] - kappa.expected) / left;
    squares += (of_subject - kappa.kappa) * (of_subject - kappa.kappa);
  }
  return with_interval(kappa, squares / (n * (n - 1.0)), t_quantile(1.0 - tail, n - 1.0));
}

}  // namespace ream::statistics
