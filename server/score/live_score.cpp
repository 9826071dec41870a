#include "score/live_score.hpp"

#include <algorithm>

#include "core/clock.hpp"

namespace ream::score {

bool LiveScore::update(const MetricsAccumulator& ticks, const CoverageView& left, int64_t now_ns) {
  if (now_ns < due_ns_) return false;
  const int64_t begun_ns = steady_ns();
  results_ = bone_results(native_, left, ticks.cut_line(), world_from_plan_, ticks.reaming_depth_mm());
  due_ns_ = now_ns + std::max(period_ns, rest_for_work * (steady_ns() - begun_ns));
  return true;
}

}  // namespace ream::score
