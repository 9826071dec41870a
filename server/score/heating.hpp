#pragma once
#include <cstdint>

#include "force/heat.hpp"
#include "record/tick_report.hpp"
#include "score/metric_results.hpp"

namespace ream::score {

/// How warm the bone under the reamer became. How deep follows from what ticks say: the surface's temperature
/// and the feed fix the profile below, whatever power and area made it so.
class Heating {
 public:
  /// Once a tick, in order.
  void add(const record::TickReport& report) noexcept;
  void write(MetricResults& results) const;

 private:
  void follow_profile(const record::TickReport& report) noexcept;

  force::HeatColumn column_;
  int ticks_ = 0;
  double advance_mm_ = 0.0;  ///< since the last step of the column
  double dead_elsewhere_mm_ = 0.0;
  double peak_c_ = 0.0;  ///< 0: heat was not simulated
  int64_t over_47_ticks_ = 0, over_56_ticks_ = 0;
};

}  // namespace ream::score
