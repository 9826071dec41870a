#include "ct/segment/threshold_suggestion.hpp"

#include <algorithm>
#include <cmath>

namespace ream::ct {
namespace {

constexpr int bin_hu = 8, histogram_lowest_hu = 0, histogram_highest_hu = 2000,
              bin_count = (histogram_highest_hu - histogram_lowest_hu) / bin_hu;
constexpr int soft_tissue_bins = 150 / bin_hu;
constexpr double half_width_per_deviation = 1.1774;  // sqrt(2 ln 2), of a normal distribution
constexpr double customary_threshold_hu = 226.0, min_threshold_hu = 100.0, max_threshold_hu = 500.0;
constexpr double deviations_of_noise = 4.0;

std::vector<size_t> histogram_of(const HuVolume& volume) {
  std::vector<size_t> counts(bin_count);
  for (const int16_t hu : volume.hu)
    if (hu >= histogram_lowest_hu && hu < histogram_highest_hu)
      ++counts[static_cast<size_t>((hu - histogram_lowest_hu) / bin_hu)];
  return counts;
}

SoftTissue soft_tissue_in(const std::vector<size_t>& counts) {
  const auto peak = std::max_element(counts.begin(), counts.begin() + soft_tissue_bins);
  auto half = peak;
  while (half != counts.end() && 2 * *half > *peak) ++half;
  if (*peak == 0 || half == counts.end()) return {};
  const double excess = static_cast<double>(*(half - 1)) - 0.5 * static_cast<double>(*peak);
  const double fall = static_cast<double>(*(half - 1)) - static_cast<double>(*half);
  const double width_hu = bin_hu * (static_cast<double>(half - 1 - peak) + excess / fall);
  return {histogram_lowest_hu + bin_hu * (static_cast<double>(peak - counts.begin()) + 0.5),
          width_hu / half_width_per_deviation};
}

}  // namespace

std::array<size_t, 2> three_class_limits(const std::vector<size_t>& counts) {
  // Sums below each bin. Greatest between-class variance is greatest sum of (class sum)^2 / class count.
  std::vector<double> number{0.0}, sum{0.0};
  for (size_t i = 0; i < counts.size(); ++i) {
    number.push_back(number.back() + static_cast<double>(counts[i]));
    sum.push_back(sum.back() + static_cast<double>(counts[i]) * static_cast<double>(i));
  }
  const auto of_class = [&](size_t from, size_t to) {
    const double n = number[to] - number[from], s = sum[to] - sum[from];
    return n > 0.0 ? s * s / n : 0.0;
  };
  std::array<size_t, 2> best{};
  double best_value = -1.0;
  for (size_t i = 1; i + 1 < counts.size(); ++i)
    for (size_t j = i + 1; j < counts.size(); ++j) {
      const double value = of_class(0, i) + of_class(i, j) + of_class(j, counts.size());
      if (value > best_value) best_value = value, best = {i, j};
    }
  return best;
}

SoftTissue soft_tissue_of(const HuVolume& volume) { return soft_tissue_in(histogram_of(volume)); }

double suggested_threshold_hu(const HuVolume& volume) {
  const std::vector<size_t> counts = histogram_of(volume);
  if (std::count(counts.begin(), counts.end(), size_t{0}) > bin_count - 3) return customary_threshold_hu;
  const double otsu = histogram_lowest_hu + bin_hu * static_cast<double>(three_class_limits(counts)[0]);
  const SoftTissue soft = soft_tissue_in(counts);
  const double above_noise = soft.hu + deviations_of_noise * soft.deviation_hu;
  return std::floor(std::clamp(std::max(otsu, above_noise), min_threshold_hu, max_threshold_hu) + 0.5);
}

}  // namespace ream::ct
