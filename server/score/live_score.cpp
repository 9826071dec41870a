#include "score/live_score.hpp"

#include <algorithm>

#include "core/clock.hpp"

namespace ream::score {

bool LiveScore::update(const MetricsAccumulator& ticks, const CoverageView& left, int64_t now_ns) {
  const int64_t begun_ns = steady_ns();
  const bool depth_is_due = now_ns >= depth_due_ns_, all_is_due = now_ns >= due_ns_;
  if (depth_is_due) {
    if (ticks.cut_line()) depth_mm_ = gauge_.measure(left);
    depth_due_ns_ = now_ns + std::max(publish_period_ns, rest_for_depth * (steady_ns() - begun_ns));
  }
  const int64_t measured_ns = steady_ns();
  if (all_is_due) {
    results_ = bone_results(native_, planned_, left, ticks.cut_line(), world_from_plan_);
    due_ns_ = now_ns + std::max(period_ns, rest_for_work * (steady_ns() - measured_ns));
  }
  if ((depth_is_due || all_is_due) && gauge_.has_face() && ticks.cut_line())
    set_depth(native_.task(), depth_mm_, results_);
  return all_is_due;
}

}  // namespace ream::score
