#include "statistics/sample_size.hpp"

#include <cmath>
#include <string>

#include "core/error.hpp"
#include "statistics/distributions.hpp"

namespace ream::statistics {
namespace {

constexpr size_t most_persons = 1'000'000;

[[noreturn]] void refuse_size(const std::string& why) {
  throw Error(ErrorKind::invalid_input, "sample size: " + why);
}

bool is_share(double value) { return value > 0.0 && value < 1.0; }

void check_aim(const TestAim& aim) {
  if (!is_share(aim.significance) || !is_share(aim.power) || aim.power <= aim.significance)
    refuse_size("significance and power must lie between 0 and 1, and power over significance");
}

size_t rounded_up(double size) {
  if (!(size <= static_cast<double>(most_persons)))
    refuse_size("so small a difference needs more than a million persons");
  // A whole number but for rounding stays one.
  return static_cast<size_t>(std::ceil(size - 1e-9));
}

}  // namespace

double power_of_two_means(double effect, size_t per_group, double significance) {
  if (per_group < 2) refuse_size("a test of two means needs two persons or more in each group");
  const double n = static_cast<double>(per_group), freedom = 2.0 * n - 2.0;
  const double limit = t_quantile(1.0 - 0.5 * significance, freedom);
  const double shift = std::abs(effect) * std::sqrt(0.5 * n);
  return 1.0 - noncentral_t_cdf(limit, freedom, shift) + noncentral_t_cdf(-limit, freedom, shift);
}

size_t size_for_two_means(double effect, const TestAim& aim) {
  check_aim(aim);
  if (!(std::abs(effect) > 0.0)) refuse_size("an effect of 0 cannot be found");

  size_t high = 2;
  while (power_of_two_means(effect, high, aim.significance) < aim.power) {
    high *= 2;
    if (high > 2 * most_persons) refuse_size("so small an effect needs more than a million persons");
  }
  size_t low = high / 2;  // too few, or one
  while (high - low > 1) {
    const size_t middle = low + (high - low) / 2;
    (power_of_two_means(effect, middle, aim.significance) < aim.power ? low : high) = middle;
  }
  return high;
}

size_t size_for_two_shares(double first, double second, const TestAim& aim) {
  check_aim(aim);
  if (!is_share(first) || !is_share(second) || first == second)
    refuse_size("two shares must lie between 0 and 1 and differ");
  const double mean = 0.5 * (first + second);
  const double under_none =
      normal_quantile(1.0 - 0.5 * aim.significance) * std::sqrt(2.0 * mean * (1.0 - mean));
  const double under_effect =
      normal_quantile(aim.power) * std::sqrt(first * (1.0 - first) + second * (1.0 - second));
  const double apart = first - second;
  return rounded_up((under_none + under_effect) * (under_none + under_effect) / (apart * apart));
}

size_t size_for_agreement_over(double least, double expected, size_t raters, const TestAim& aim) {
  check_aim(aim);
  if (raters < 2 || !(least >= 0.0 && least < expected && expected < 1.0))
    refuse_size("agreement needs 0 <= least < expected < 1 and two raters or more");
  const double n = static_cast<double>(raters);
  const auto odds = [](double rho) { return rho / (1.0 - rho); };
  const double ratio = std::log((1.0 + n * odds(least)) / (1.0 + n * odds(expected)));
  const double z = normal_quantile(1.0 - aim.significance) + normal_quantile(aim.power);
  return rounded_up(1.0 + 2.0 * z * z * n / (ratio * ratio * (n - 1.0)));
}

size_t size_for_agreement_width(double expected, double width, size_t raters, double confidence) {
  if (raters < 2 || !is_share(expected) || !(width > 0.0 && width < 2.0))
    refuse_size("agreement needs 0 < expected < 1, 0 < width < 2 and two raters or more");
  const double z = normal_quantile(1.0 - tail_of(confidence)), k = static_cast<double>(raters);
  const double apart = (1.0 - expected) * (1.0 + (k - 1.0) * expected);
  double size = 8.0 * z * z * apart * apart / (k * (k - 1.0) * width * width) + 1.0;
  if (raters == 2 && expected >= 0.7) size += 5.0 * expected;
  return rounded_up(size);
}

}  // namespace ream::statistics
