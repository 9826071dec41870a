#include "report/trace_summary.hpp"

#include <algorithm>

namespace ream::report {

TraceSummary::TraceSummary(uint32_t ticks, const Pose& plan_from_world)
    : bin_ticks_(std::max(1u, (ticks + max_bins - 1) / max_bins)), plan_from_world_(plan_from_world) {
  bins_.reserve(ticks / bin_ticks_ + 1);
}

void TraceSummary::add(const record::TickReport& r) {
  const bool first = left_in_bin_ == 0;
  if (first) {
    bins_.emplace_back();
    left_in_bin_ = bin_ticks_;
  }
  --left_in_bin_;
  ++ticks_;
  TraceBin& bin = bins_.back();
  const double thrust_n = r.engaged ? r.thrust_n : 0.0, feed_mm_s = r.cutting ? r.feed_rate_mm_s : 0.0;
  bin.thrust_low_n = first ? thrust_n : std::min(bin.thrust_low_n, thrust_n);
  bin.thrust_high_n = first ? thrust_n : std::max(bin.thrust_high_n, thrust_n);
  bin.feed_low_mm_s = first ? feed_mm_s : std::min(bin.feed_low_mm_s, feed_mm_s);
  bin.feed_high_mm_s = first ? feed_mm_s : std::max(bin.feed_high_mm_s, feed_mm_s);
  if (!r.engaged) return;
  const Vec3 in_bone_mm = r.world_from_bone_rest.inverse().point(r.world_from_tool.translation_mm);
  const double axial_mm = plan_from_world_.point(in_bone_mm).z();
  if (!first_contact_mm_) first_contact_mm_ = axial_mm;
  const double depth_mm = axial_mm - *first_contact_mm_;
  deepest_mm_ = std::max(deepest_mm_, depth_mm);
  bin.depth_mm = std::max(bin.depth_mm.value_or(depth_mm), depth_mm);
  bin.touched = true;
}

}  // namespace ream::report
