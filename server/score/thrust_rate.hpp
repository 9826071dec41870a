#pragma once
#include <array>
#include <cstdint>

#include "record/tick_report.hpp"
#include "score/metric_results.hpp"

namespace ream::score {

/// How evenly a hand presses while it cuts: the root mean square of the rate at which thrust changes, over
/// the mean thrust. 0 for a steady thrust, the same for all thrusts in proportion, and it does not grow with
/// the time. Thrust is low-passed as its means over 50 ms, which halves the power of a tremor of 9 Hz; rates
/// are those between one mean and the next. Looked at are presses with at least 5 N while the spindle turns
/// in bone; the first and the last quarter of a second of each, in which thrust is put on and taken off, are
/// left out.
class ThrustRate {
 public:
  static constexpr int ticks_a_mean = 50;
  static constexpr size_t means_left_out = 5;  ///< at either end of a press

  /// Once a tick.
  void add(const record::TickReport& report);
  void write(MetricResults& results) const;

 private:
  void take_mean(double mean_n);
  void end_press();

  double sum_n_ = 0.0;  ///< of ticks_
  int ticks_ = 0;
  size_t means_ = 0;                                 ///< of this press
  std::array<double, means_left_out + 2> last_n_{};  ///< mean i at i modulo their number
  double squares_n2_ = 0.0, total_n_ = 0.0;
  int64_t changes_ = 0;
};

}  // namespace ream::score
