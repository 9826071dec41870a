#pragma once
#include <memory>

#include "score/bone_results.hpp"
#include "score/depth_gauge.hpp"
#include "score/metrics.hpp"
#include "score/planned_face.hpp"

namespace ream::score {

/// What the bone tells during a session, measured three times a second on rays 1 mm apart (the final
/// score's are 0.25 mm apart). Takes less than 1 % of a core: after a measurement it rests for 100 times as
/// long as that took. How deep the reaming is, it measures ten times a second, with up to 5 % of a core. Used
/// by one thread.
class LiveScore {
 public:
  static constexpr int stride = 4;
  static constexpr int64_t period_ns = 333'000'000;
  static constexpr int64_t rest_for_work = 100, rest_for_depth = 20;
  /// How often it is enough to publish metrics: ten times a second.
  static constexpr int64_t publish_period_ns = 100'000'000;

  LiveScore(const std::shared_ptr<const NativeGlenoid>& native, const Pose& world_from_plan)
      : gauge_(native),
        native_(native->thinned(stride)),
        planned_(planned_face(native_)),
        world_from_plan_(world_from_plan),
        results_(missing_bone_results("it is measured when the session has begun")) {}

  /// Measures anew if it is due and tells whether it did. `left`: the bone as a follower has it. `now_ns`: as
  /// steady_ns().
  bool update(const MetricsAccumulator& ticks, const CoverageView& left, int64_t now_ns);
  const MetricResults& results() const { return results_; }
  /// As DepthGauge measured it last.
  double depth_mm() const { return depth_mm_; }

 private:
  DepthGauge gauge_;
  const NativeGlenoid native_;
  const PlannedFace planned_;
  const Pose world_from_plan_;
  MetricResults results_;
  double depth_mm_ = 0.0;
  int64_t due_ns_ = 0, depth_due_ns_ = 0;
};

}  // namespace ream::score
