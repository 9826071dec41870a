#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

namespace ream {

/// What a histogram says; all in microseconds.
struct TimingSummary {
  double mean_us = 0, p50_us = 0, p99_us = 0, p999_us = 0, max_us = 0;
  uint64_t count = 0;
};

/// Durations counted in bins of 0.1 us up to 20 us and of 1 us up to 20 ms (longer ones in the last bin; the
/// maximum stays exact). Adding is a handful of instructions: it is used in the tick.
class TimingHistogram {
 public:
  void add(double us) noexcept {
    ++bins_[bin_of(us)];
    ++count_;
    sum_us_ += us;
    if (us > max_us_) max_us_ = us;
  }

  /// Percentiles are upper edges of their bins, at most the maximum.
  TimingSummary summary() const noexcept {
    TimingSummary found{
        count_ ? sum_us_ / static_cast<double>(count_) : 0.0, max_us_, max_us_, max_us_, max_us_, count_};
    const std::array quantiles{Quantile{0.5, &found.p50_us}, Quantile{0.99, &found.p99_us},
                               Quantile{0.999, &found.p999_us}};
    uint64_t seen = 0;
    size_t next = 0;
    for (size_t i = 0; i + 1 < bins_.size() && next < quantiles.size(); ++i) {
      seen += bins_[i];
      for (; next < quantiles.size() &&
             static_cast<double>(seen) >= quantiles[next].fraction * static_cast<double>(count_);
           ++next)
        if (upper_edge_us(i) < max_us_) *quantiles[next].us = upper_edge_us(i);
    }
    return found;
  }

 private:
  struct Quantile {
    double fraction;
    double* us;
  };
  static constexpr size_t fine_bins_a_us = 10, fine_us = 20, fine_bins = fine_bins_a_us * fine_us;
  static constexpr size_t max_binned_us = 20000;

  static size_t bin_of(double us) noexcept {
    if (!(us > 0.0)) return 0;
    if (us < static_cast<double>(fine_us)) return static_cast<size_t>(us * fine_bins_a_us);
    if (us < static_cast<double>(max_binned_us)) return fine_bins + static_cast<size_t>(us) - fine_us;
    return fine_bins + max_binned_us - fine_us;
  }
  static double upper_edge_us(size_t bin) noexcept {
    return bin < fine_bins ? static_cast<double>(bin + 1) / fine_bins_a_us
                           : static_cast<double>(bin - fine_bins + fine_us + 1);
  }

  std::array<uint32_t, fine_bins + max_binned_us - fine_us + 1> bins_{};
  uint64_t count_ = 0;
  double sum_us_ = 0.0, max_us_ = 0.0;
};

}  // namespace ream
