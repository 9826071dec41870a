#pragma once
#include "core/clock.hpp"
#include "record/tick_report.hpp"

namespace ream::test {

/// How a reamer leaves its pocket, followed tick by tick.
class WayOut {
 public:
  /// `hand_force_n`: of the hand on the device, world frame, in that tick.
  void follow(const record::TickReport& report, const Vec3& hand_force_n) {
    cut_ = cut_ || report.cutting;
    if (report.engaged) last_engaged_tick_ = report.tick;
    const double pull_n = -hand_force_n.dot(report.world_from_tool.rotation.col(2));
    if (!withdrawn() && cut_ && pull_n > min_pull_n) withdrawn_tick_ = report.tick;
    if (!withdrawn()) return;
    for (const int64_t levels : report.coverage_removed) removed_levels_ += levels;
  }

  /// The hand has drawn back for good: these robots do so once.
  bool withdrawn() const { return withdrawn_tick_ > 0; }
  double seconds_to_be_free() const {
    return !withdrawn() || last_engaged_tick_ < withdrawn_tick_
               ? 0.0
               : tick_s * (last_engaged_tick_ - withdrawn_tick_);
  }
  int64_t removed_levels() const { return removed_levels_; }  ///< since then, 1/255 voxel

 private:
  static constexpr double min_pull_n = 0.1;

  bool cut_ = false;
  uint32_t withdrawn_tick_ = 0, last_engaged_tick_ = 0;
  int64_t removed_levels_ = 0;
};

}  // namespace ream::test
