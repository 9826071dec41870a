#pragma once
#include <filesystem>
#include <string>

#include "core/progress.hpp"
#include "report/report.hpp"

namespace ream::app {

/// What a report is asked of.
struct ReportRequest {
  std::filesystem::path recording;  ///< recording.ream; session.json lies beside it where there is one
  std::string case_name;            ///< where the case is, as for find_case(); empty: as recorded
  std::filesystem::path data;
  std::string rubric = "standard";  ///< as score::find_rubric
  std::string benchmark;            ///< file; empty: none
  bool with_pictures = true;
};

/// Reads a session once more and says all that it says. What cannot be had (the case, its bone) is said in
/// the report instead. Errors: those of the recording, rubric and benchmark.
report::Report session_report(const ReportRequest& request, const Progress& progress);

}  // namespace ream::app
