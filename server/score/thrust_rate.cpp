#include "score/thrust_rate.hpp"

#include <cmath>
#include <optional>

#include "core/clock.hpp"
#include "score/spindle_use.hpp"

namespace ream::score {

void ThrustRate::add(const record::TickReport& r) {
  if (r.paused || !r.engaged || !r.spindle_on || r.thrust_n < pressing_n) return end_press();
  sum_n_ += r.thrust_n;
  if (++ticks_ < ticks_a_mean) return;
  take_mean(sum_n_ / ticks_a_mean);
  sum_n_ = 0.0;
  ticks_ = 0;
}

/// Whether a mean belongs to the end of a press is known when as many have come after it.
void ThrustRate::take_mean(double mean_n) {
  last_n_[means_++ % last_n_.size()] = mean_n;
  if (means_ < 2 * means_left_out + 2) return;
  const double now_n = last_n_[(means_ - 1 - means_left_out) % last_n_.size()];
  const double before_n = last_n_[(means_ - 2 - means_left_out) % last_n_.size()];
  squares_n2_ += (now_n - before_n) * (now_n - before_n);
  total_n_ += 0.5 * (now_n + before_n);
  ++changes_;
}

void ThrustRate::end_press() {
  sum_n_ = 0.0;
  ticks_ = 0;
  means_ = 0;
}

void ThrustRate::write(MetricResults& results) const {
  std::optional<double> rate_percent_s;
  if (changes_ > 0) {
    const auto changes = static_cast<double>(changes_);
    const double rms_n_s = std::sqrt(squares_n2_ / changes) / (ticks_a_mean * tick_s);
    rate_percent_s = 100.0 * rms_n_s / (total_n_ / changes);
  }
  results.set_or_missing("thrust_rate_percent_s", rate_percent_s,
                         "the reamer was not pressed with 5 N for 0.6 s in one go");
}

}  // namespace ream::score
