#pragma once
#include <cstdio>
#include <filesystem>
#include <string>

#include "core/clock.hpp"
#include "record/tick_report.hpp"

namespace ream::record {

/// The values of trace_columns() tick after tick, all of which it must be shown.
class TraceValues {
 public:
  /// `plan_from_world`: of the bone where the case has it, z along the planned axis.
  TraceValues(double voxel_volume_mm3, const Pose& plan_from_world)
      : voxel_volume_mm3_(voxel_volume_mm3), plan_from_world_(plan_from_world) {}

  /// Counts what the tick removed, without a row of its own.
  void pass(const TickReport& r) {
    for (const int64_t removed : r.coverage_removed) coverage_removed_ += removed;
  }
  /// Calls row.add() with double, int64_t, Vec3 or Pose (place, quaternion w, x, y, z), column by column.
  template <typename Row>
  void add(const TickReport& r, Row& row) {
    pass(r);
    row.add(static_cast<double>(r.tick) * tick_s).add(r.world_from_handle).add(r.world_from_tool);
    row.add(int64_t{r.spindle_on}).add(int64_t{r.paused}).add(r.thrust_n).add(r.hand_force_n);
    row.add(r.torque_n_mm).add(r.spindle_torque_n_mm).add(r.guide_force_n).add(r.vibration_g);
    row.add(int64_t{r.weakened}).add(r.feed_rate_mm_s).add(r.density_g_cc);
    row.add(r.share[0]).add(r.share[1]).add(r.share[2]).add(r.engaged_points);
    row.add(static_cast<double>(coverage_removed_) / 255.0 * voxel_volume_mm3_).add(r.world_from_bone_rest);
    row.add(r.spindle_speed_rad_s).add(int64_t{r.stalled}).add(int64_t{r.drive.irrigating});
    const Pose bone_from_tool = r.world_from_bone_rest.inverse() * r.world_from_tool;
    row.add(r.surface_temperature_c).add((plan_from_world_ * bone_from_tool).translation_mm.z());
  }

 private:
  double voxel_volume_mm3_;
  Pose plan_from_world_;
  int64_t coverage_removed_ = 0;
};

/// trace.csv, one row a tick; trace_columns() says what is in it. Written to a temporary name and renamed by
/// finish(), so an interrupted run leaves no half trace.
class TraceCsv {
 public:
  /// As for TraceValues. Throws Error io when the file cannot be created.
  TraceCsv(const std::filesystem::path& path, double voxel_volume_mm3, const Pose& plan_from_world);
  ~TraceCsv();
  TraceCsv(const TraceCsv&) = delete;
  TraceCsv& operator=(const TraceCsv&) = delete;

  void add(const TickReport& report);
  void pass(const TickReport& report) { values_.pass(report); }
  /// Throws Error io when anything could not be written.
  void finish();

  static const std::string& header_line();

 private:
  std::filesystem::path path_, temporary_;
  std::FILE* file_ = nullptr;
  TraceValues values_;
};

}  // namespace ream::record
