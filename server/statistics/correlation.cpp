#include "statistics/correlation.hpp"

#include <cmath>

#include "core/error.hpp"
#include "statistics/distributions.hpp"
#include "statistics/regression.hpp"
#include "statistics/sample.hpp"

namespace ream::statistics {

Answer<Correlation> pearson(std::span<const double> x, std::span<const double> y, double confidence) {
  const double tail = tail_of(confidence);
  if (x.size() != y.size())
    throw Error(ErrorKind::invalid_input, "a correlation needs as many values of one as of the other");
  if (x.size() < 3) return {std::nullopt, "a correlation needs three pairs or more"};
  if (all_equal(x) || all_equal(y))
    return {std::nullopt, "a correlation needs values that differ, and all of one side are equal"};
  const Regression line = regression(x, y);
  Correlation result{x.size(), line.rho, line.p, std::nullopt};
  if (x.size() < 4) return {result, "the interval of a correlation needs four pairs or more"};
  if (std::abs(line.rho) >= 1.0) return {result, "all pairs lie on a line, which has no interval"};
  const double reach = normal_quantile(1.0 - tail) / std::sqrt(static_cast<double>(x.size()) - 3.0);
  const double middle = std::atanh(line.rho);
  result.interval = Interval{std::tanh(middle - reach), std::tanh(middle + reach)};
  return {result, ""};
}

Answer<Correlation> spearman(std::span<const double> x, std::span<const double> y) {
  Answer<Correlation> result = pearson(ranks_of(x), ranks_of(y));
  if (!result) return result;
  result.value->interval.reset();
  return {*result, ""};
}

}  // namespace ream::statistics
