#pragma once
#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "record/tick_report.hpp"
#include "score/breakthrough.hpp"
#include "score/contact_passes.hpp"
#include "score/cut_axis.hpp"
#include "score/findings.hpp"
#include "score/tool_path.hpp"
#include "voxel/bone_model.hpp"

namespace ream::score {

/// What is known of a run so far; the first metrics of metrics.json. Volumes leave the pilot hole out (it is
/// gone before the first tick), forces are simulated newtons.
struct Metrics {
  double removed_volume_mm3 = 0.0;
  double removed_volume_cortical_mm3 = 0.0;
  double removed_volume_cancellous_mm3 = 0.0;
  double removed_volume_cartilage_mm3 = 0.0;
  /// How far the tool's apex went along the planned axis from first contact while removing, mm.
  double reaming_depth_mm = 0.0;
  double axial_thrust_mean_n = 0.0;  ///< over the ticks in contact with the spindle on
  double axial_thrust_peak_n = 0.0;
  /// Thrust gained a mm of advance while thrust rises for the first time from stiffness_from_n to
  /// stiffness_to_n (thesis 5.2: apparent machining stiffness); empty when it has not, or without advance.
  std::optional<double> apparent_stiffness_n_mm;
  double duration_s = 0.0;
  double contact_time_s = 0.0;
  double weakened_time_s = 0.0;  ///< in which the hand felt noticeably less than what was simulated
  uint64_t session_hash = 0;
};

/// Apparent stiffness is measured from the thrust at which lips begin to cut to 90 % of the experiments' 52
/// N.
inline constexpr double stiffness_from_n = 1.0, stiffness_to_n = 0.9 * 52.0;

/// Thrust beyond this is excess: 1.5 times the experiments' 52 N (science 2.2).
inline constexpr double excess_from_n = 78.0;

/// Accumulates metrics from tick reports, in order. Sums in a fixed order, so equal runs give equal bytes.
class MetricsAccumulator {
 public:
  /// `plan_from_world`: inverse of the plan frame (z along the axis into the bone), with the bone at rest.
  MetricsAccumulator(double voxel_volume_mm3, const Pose& plan_from_world);
  void add(const record::TickReport& report);
  Metrics metrics() const;
  /// How the tool was handled: what ticks say beside those.
  Findings handling() const;
  /// Along which line it cut last; plan frame.
  std::optional<CutLine> cut_line() const { return cut_axis_.line(); }

 private:
  void follow_rise(const record::TickReport& report, double axial_mm);

  double voxel_volume_mm3_;
  Pose plan_from_world_;
  int64_t ticks_ = 0, contact_ticks_ = 0, cutting_ticks_ = 0, weakened_ticks_ = 0;
  int64_t coverage_removed_[voxel::bone_class_count] = {};
  double thrust_sum_n_ = 0.0, thrust_peak_n_ = 0.0;
  bool touched_ = false;
  double first_contact_mm_ = 0.0, deepest_mm_ = 0.0;
  bool rising_ = false;  ///< thrust is over stiffness_from_n since rise_thrust_n_ at rise_mm_
  double rise_thrust_n_ = 0.0, rise_mm_ = 0.0;
  bool risen_ = false;
  std::optional<double> apparent_stiffness_n_mm_;
  uint64_t session_hash_ = 0;
  double thrust_excess_n_s_ = 0.0;
  CutAxis cut_axis_;
  Breakthrough breakthrough_;
  PlateStop plate_stop_;
  ContactPasses passes_;
  ToolPath path_;
};

/// The keys of metrics.json (DESIGN 4). `grid_hash` is null when not given (a run still going on).
nlohmann::json metrics_json(const Metrics& metrics, double force_scale, const uint64_t* grid_hash);

}  // namespace ream::score
