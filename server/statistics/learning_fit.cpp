#include "statistics/learning_fit.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "core/error.hpp"
#include "statistics/distributions.hpp"
#include "statistics/regression.hpp"

namespace ream::statistics {
namespace {

/// For a given rate the curve is a line over exp(-rate (attempt - 1)).
struct CurveAt {
  double plateau = 0.0, gain = 0.0;
  double squares = 0.0;  ///< left over
};

class Curve {
 public:
  Curve(std::span<const double> attempts, std::span<const double> values)
      : attempts_(attempts), values_(values), share_(attempts.size()) {}

  CurveAt at(double rate) {
    for (size_t i = 0; i < share_.size(); ++i) share_[i] = std::exp(-rate * (attempts_[i] - 1.0));
    const Regression line = regression(share_, values_);
    CurveAt found{line.intercept, line.slope, 0.0};
    for (size_t i = 0; i < share_.size(); ++i) {
      const double off = values_[i] - found.plateau - found.gain * share_[i];
      found.squares += off * off;
    }
    return found;
  }

  /// The best rate, of which the logarithm is looked for; empty when it lies at an end.
  std::optional<double> best_rate() {
    constexpr int steps = 200;
    const double first = std::log(min_learning_rate), last = std::log(max_learning_rate);
    const double step = (last - first) / steps;
    int best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= steps; ++i)
      if (const double here = at(std::exp(first + i * step)).squares; here < least) {
        least = here;
        best = i;
      }
    const double low = first + std::max(best - 1, 0) * step, high = first + std::min(best + 1, steps) * step;
    const double found = std::exp(golden(low, high));
    const double at_ends = std::min(at(min_learning_rate).squares, at(max_learning_rate).squares);
    if (at(found).squares >= at_ends) return std::nullopt;
    return found;
  }

 private:
  /// Golden section search of the least squares between two logarithms.
  double golden(double low, double high) {
    const double cut = 0.5 * (std::sqrt(5.0) - 1.0);
    double left = high - cut * (high - low), right = low + cut * (high - low);
    double at_left = at(std::exp(left)).squares, at_right = at(std::exp(right)).squares;
    for (int i = 0; i < 60; ++i) {
      if (at_left < at_right) {
        high = right;
        right = left;
        at_right = at_left;
        left = high - cut * (high - low);
        at_left = at(std::exp(left)).squares;
      } else {
        low = left;
        left = right;
        at_left = at_right;
        right = low + cut * (high - low);
        at_right = at(std::exp(right)).squares;
      }
    }
    return 0.5 * (low + high);
  }

  std::span<const double> attempts_, values_;
  std::vector<double> share_;
};

/// Inverse of J'J for start, plateau and rate.
Eigen::Matrix3d inverse_information(std::span<const double> attempts, const LearningFit& fit) {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  for (const double attempt : attempts) {
    const double share = std::exp(-fit.rate * (attempt - 1.0));
    const Eigen::Vector3d slope(share, 1.0 - share, -(fit.start - fit.plateau) * (attempt - 1.0) * share);
    information += slope * slope.transpose();
  }
  return information.inverse();
}

}  // namespace

Answer<LearningFit> learning_fit(std::span<const double> attempts, std::span<const double> values,
                                 double confidence) {
  const double tail = tail_of(confidence);
  if (attempts.size() != values.size())
    throw Error(ErrorKind::invalid_input, "a learning curve needs as many values as attempts");
  if (values.size() < 5 || std::set<double>(attempts.begin(), attempts.end()).size() < 4)
    return {std::nullopt, "a learning curve needs five values or more, at four attempts or more"};
  if (std::set<double>(values.begin(), values.end()).size() < 2)
    return {std::nullopt, "all values are equal, so that there is no learning curve"};
  Curve curve(attempts, values);
  const std::optional<double> rate = curve.best_rate();
  if (!rate)
    return {std::nullopt, "the values do not bend towards a plateau, so that there is no learning curve"};
  const CurveAt best = curve.at(*rate);
  const double freedom = static_cast<double>(values.size()) - 3.0;
  LearningFit fit;
  fit.n = values.size();
  fit.rate = *rate;
  fit.plateau = best.plateau;
  fit.start = best.plateau + best.gain;
  fit.residual_sd = std::sqrt(best.squares / freedom);
  fit.attempts_to_half = std::log(2.0) / *rate;
  const Eigen::Matrix3d inverse = inverse_information(attempts, fit);
  const double reach = t_quantile(1.0 - tail, freedom) * fit.residual_sd;
  const auto around = [&](double estimate, int i) {
    const double half = reach * std::sqrt(inverse(i, i));
    return Interval{estimate - half, estimate + half};
  };
  fit.start_interval = around(fit.start, 0);
  fit.plateau_interval = around(fit.plateau, 1);
  fit.rate_interval = around(fit.rate, 2);
  if (!(fit.rate_interval.low > 0.0))
    return {std::nullopt, "the rate of learning cannot be told from 0, so that there is no learning curve"};
  return {fit, ""};
}

}  // namespace ream::statistics
