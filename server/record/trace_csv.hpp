#pragma once
#include <cstdio>
#include <filesystem>
#include <string>

#include "record/tick_report.hpp"

namespace ream::record {

/// trace.csv, one row a tick; trace_columns() says what is in it. Written to a temporary name and renamed by
/// finish(), so an interrupted run leaves no half trace.
class TraceCsv {
 public:
  /// `plan_from_world`: of the bone where the case has it, z along the planned axis. Throws Error io when the
  /// file cannot be created.
  TraceCsv(const std::filesystem::path& path, double voxel_volume_mm3, const Pose& plan_from_world);
  ~TraceCsv();
  TraceCsv(const TraceCsv&) = delete;
  TraceCsv& operator=(const TraceCsv&) = delete;

  void add(const TickReport& report);
  /// Counts what the tick removed, without a row of its own.
  void pass(const TickReport& report);
  /// Throws Error io when anything could not be written.
  void finish();

  static const std::string& header_line();

 private:
  std::filesystem::path path_, temporary_;
  std::FILE* file_ = nullptr;
  double voxel_volume_mm3_;
  Pose plan_from_world_;
  int64_t coverage_removed_ = 0;
};

}  // namespace ream::record
