#include "score/group_density.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ream::score {
namespace {

/// Quantile by linear interpolation between order statistics.
double quantile(const std::vector<double>& sorted, double share) {
  const double at = share * static_cast<double>(sorted.size() - 1);
  const size_t low = static_cast<size_t>(at);
  const size_t high = std::min(low + 1, sorted.size() - 1);
  return sorted[low] + (at - static_cast<double>(low)) * (sorted[high] - sorted[low]);
}

double silverman_width(std::vector<double> values, double sd) {
  std::sort(values.begin(), values.end());
  const double iqr = quantile(values, 0.75) - quantile(values, 0.25);
  const double scale = iqr > 0.0 ? std::min(sd, iqr / 1.34) : sd;
  return 0.9 * scale * std::pow(static_cast<double>(values.size()), -0.2);
}

}  // namespace

Spread spread_of(std::span<const double> values) {
  Spread result;
  for (const double value : values) result.mean += value;
  result.mean /= static_cast<double>(values.size());
  double squares = 0.0;
  for (const double value : values) squares += (value - result.mean) * (value - result.mean);
  result.sd = std::sqrt(squares / static_cast<double>(values.size() - 1));
  return result;
}

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

}  // namespace ream::score
