#pragma once
#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "record/tick_report.hpp"
#include "score/cut_axis.hpp"
#include "score/handling.hpp"
#include "score/heating.hpp"
#include "score/metric_results.hpp"
#include "voxel/bone_model.hpp"

namespace ream::score {

/// What the ticks of a session tell, added in order. Sums in a fixed order, so equal runs give equal bytes.
/// Volumes leave the pilot hole out (it is gone before the first tick), forces are simulated newtons.
class MetricsAccumulator {
 public:
  /// `plan_from_world`: inverse of the plan frame (z along the axis into the bone), with the bone at rest.
  MetricsAccumulator(double voxel_volume_mm3, const Pose& plan_from_world);
  void add(const record::TickReport& report);

  /// Every metric that rests on ticks or on an episode among them.
  MetricResults results() const;
  double removed_volume_mm3() const;
  double duration_s() const { return handling_.duration_s(); }
  uint64_t session_hash() const { return session_hash_; }
  /// Along which line the tool cut last; plan frame.
  std::optional<CutLine> cut_line() const { return cut_axis_.line(); }

 private:
  double removed_mm3(voxel::BoneClass bone_class) const;

  double voxel_volume_mm3_;
  Pose plan_from_world_;
  int64_t coverage_removed_[voxel::bone_class_count] = {};
  uint64_t session_hash_ = 0;
  CutAxis cut_axis_;
  Handling handling_;
  Heating heating_;
  AxisSteadiness axis_steadiness_;
};

/// metrics.json (proto/metrics.schema.json): what the ticks tell, what the bone tells, and for every metric
/// that is null why. `grid_hash` is null when not given (a run still going on).
nlohmann::json session_metrics_json(const MetricsAccumulator& ticks, const MetricResults& of_bone,
                                    double force_scale, const uint64_t* grid_hash);

}  // namespace ream::score
