#include "force/feed_table.hpp"

#include <algorithm>
#include <bit>

#include "core/error.hpp"
#include "core/hash.hpp"

namespace ream::force {
namespace {

constexpr double smallest_feed_mm = 1e-4, largest_feed_mm = 5.0;
constexpr double feed_ratio = 17.0 / 16.0;

/// `y` at `at` on the line through the two rows of the ascending `x` around it.
double interpolated(const std::vector<double>& x, const std::vector<double>& y, double at) noexcept {
  const auto above = std::upper_bound(x.begin() + 1, x.end() - 1, at);
  const auto i = static_cast<size_t>(above - x.begin());
  return y[i - 1] + (at - x[i - 1]) * ((y[i] - y[i - 1]) / (x[i] - x[i - 1]));
}

}  // namespace

FeedTable::FeedTable(std::vector<double> feed_mm, std::vector<double> thrust_mm2,
                     std::vector<double> torque_mm3)
    : feed_mm_(std::move(feed_mm)), thrust_mm2_(std::move(thrust_mm2)), torque_mm3_(std::move(torque_mm3)) {
  for (const std::vector<double>* column : {&feed_mm_, &thrust_mm2_, &torque_mm3_})
    for (const double value : *column) hash_ = hash_combine(hash_, std::bit_cast<uint64_t>(value));
}

double FeedTable::thrust_mm2_at(double feed_mm) const noexcept {
  return interpolated(feed_mm_, thrust_mm2_, feed_mm);
}

double FeedTable::torque_mm3_at(double feed_mm) const noexcept {
  return interpolated(feed_mm_, torque_mm3_, feed_mm);
}

double FeedTable::feed_mm_at(double thrust_mm2) const noexcept {
  return interpolated(thrust_mm2_, feed_mm_, thrust_mm2);
}

FeedTable make_feed_table(const Lip& lip, const CuttingCoefficients& coefficients, double spindle_rad_s) {
  std::vector<double> feeds{0.0}, thrusts{0.0}, torques{0.0};
  double feed_mm = smallest_feed_mm;
  while (feeds.back() < largest_feed_mm) {
    const LipLoad load = whole_load(lip_loads(lip, coefficients, {feed_mm, spindle_rad_s, 1.0}));
    if (!(load.thrust_n > thrusts.back()))
      throw Error(ErrorKind::invalid_input,
                  "the tool's lips take no more thrust when they are fed faster; use a tool with a cutting "
                  "surface beyond a sixth of its radius, or a larger friction coefficient");
    feeds.push_back(feed_mm);
    thrusts.push_back(load.thrust_n);
    torques.push_back(load.torque_n_mm);
    feed_mm *= feed_ratio;
  }
  return {std::move(feeds), std::move(thrusts), std::move(torques)};
}

}  // namespace ream::force
