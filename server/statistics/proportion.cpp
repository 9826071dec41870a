#include "statistics/proportion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "statistics/distributions.hpp"

namespace ream::statistics {
namespace {

void check_counts(size_t successes, size_t trials) {
  if (trials == 0 || successes > trials)
    throw Error(ErrorKind::invalid_input,
                "a share needs at least one trial, and no more successes than trials");
}

}  // namespace

double d_prime_of_share(double right) {
  if (right <= 0.0) return -std::numeric_limits<double>::infinity();
  if (right >= 1.0) return std::numeric_limits<double>::infinity();
  return std::sqrt(2.0) * normal_quantile(right);
}

Interval wilson_interval(size_t successes, size_t trials, double confidence) {
  const double z = normal_quantile(1.0 - tail_of(confidence));
  check_counts(successes, trials);
  const double n = static_cast<double>(trials), share = static_cast<double>(successes) / n;
  const double middle = (share + z * z / (2.0 * n)) / (1.0 + z * z / n);
  const double reach = z * std::sqrt(share * (1.0 - share) / n + z * z / (4.0 * n * n)) / (1.0 + z * z / n);
  return {std::max(0.0, middle - reach), std::min(1.0, middle + reach)};
}

Interval clopper_pearson_interval(size_t successes, size_t trials, double confidence) {
  const double tail = tail_of(confidence);
  check_counts(successes, trials);
  const double k = static_cast<double>(successes), n = static_cast<double>(trials);
  return {successes == 0 ? 0.0 : beta_quantile(tail, k, n - k + 1.0),
          successes == trials ? 1.0 : beta_quantile(1.0 - tail, k + 1.0, n - k)};
}

Answer<BinomialTest> binomial_test(size_t successes, size_t trials, double expected, double confidence) {
  if (!(expected > 0.0 && expected < 1.0))
    throw Error(ErrorKind::invalid_input, "the expected share must lie between 0 and 1");
  if (trials == 0) return {std::nullopt, "no trial"};
  check_counts(successes, trials);
  BinomialTest test;
  test.share = static_cast<double>(successes) / static_cast<double>(trials);
  test.interval = clopper_pearson_interval(successes, trials, confidence);
  test.p_greater = successes == 0 ? 1.0 : 1.0 - binomial_cdf(successes - 1, trials, expected);
  // Numbers that are as likely but for rounding count as such.
  const double limit = binomial_density(successes, trials, expected) * (1.0 + 1e-7);
  double sum = 0.0;
  for (size_t k = 0; k <= trials; ++k) {
    const double chance = binomial_density(k, trials, expected);
    if (chance <= limit) sum += chance;
  }
  test.p_two_sided = std::min(1.0, sum);
  return {test, ""};
}

}  // namespace ream::statistics
