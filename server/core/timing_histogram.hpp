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

/// Durations counted in 1 us bins up to 20 ms (longer ones in the last bin; the maximum stays exact). Adding
/// is a handful of instructions: it is used in the tick.
class TimingHistogram {
 public:
  void add(double us) noexcept {
    const auto bin = us < 0.0                                      ? size_t{0}
                     : us >= static_cast<double>(bins_.size() - 1) ? bins_.size() - 1
                                                                   : static_cast<size_t>(us);
    ++bins_[bin];
    ++count_;
    sum_us_ += us;
    if (us > max_us_) max_us_ = us;
  }

  /// Percentiles are upper edges of their bins, at most the maximum.
  TimingSummary summary() const noexcept {
    return {count_ ? sum_us_ / static_cast<double>(count_) : 0.0,
            percentile(0.5),
            percentile(0.99),
            percentile(0.999),
            max_us_,
            count_};
  }

 private:
  double percentile(double fraction) const noexcept {
    if (count_ == 0) return 0.0;
    const double wanted = fraction * static_cast<double>(count_);
    uint64_t seen = 0;
    for (size_t i = 0; i + 1 < bins_.size(); ++i) {
      seen += bins_[i];
      if (static_cast<double>(seen) >= wanted)
        return static_cast<double>(i + 1) < max_us_ ? static_cast<double>(i + 1) : max_us_;
    }
    return max_us_;
  }

  std::array<uint32_t, 20001> bins_{};
  uint64_t count_ = 0;
  double sum_us_ = 0.0, max_us_ = 0.0;
};

}  // namespace ream
