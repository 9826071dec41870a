#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/pose.hpp"
#include "record/tick_report.hpp"

namespace ream::report {

/// What happened in one of equal parts of a session.
struct TraceBin {
  double thrust_low_n = 0.0, thrust_high_n = 0.0;    ///< simulated
  double feed_low_mm_s = 0.0, feed_high_mm_s = 0.0;  ///< while cutting
  std::optional<double> depth_mm;  ///< of the tool's apex past first contact while it touches, greatest
  bool touched = false;
};

/// A session in little: a few hundred parts whatever its length. Ticks are added in order.
class TraceSummary {
 public:
  static constexpr uint32_t max_bins = 720;

  /// `ticks`: how many will come. `plan_from_world`: as MetricsAccumulator.
  TraceSummary(uint32_t ticks, const Pose& plan_from_world);
  void add(const record::TickReport& report);

  const std::vector<TraceBin>& bins() const { return bins_; }
  double bin_s() const { return bin_ticks_ * 1e-3; }
  double duration_s() const { return ticks_ * 1e-3; }
  double deepest_mm() const { return deepest_mm_; }

 private:
  uint32_t bin_ticks_ = 1, ticks_ = 0, left_in_bin_ = 0;
  Pose plan_from_world_;
  std::optional<double> first_contact_mm_;
  double deepest_mm_ = 0.0;
  std::vector<TraceBin> bins_;
};

}  // namespace ream::report
