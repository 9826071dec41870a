#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "core/progress.hpp"
#include "record/recording.hpp"

namespace ream::app {

/// What is to be exported, and what it needs beside the recording.
struct ExportRequest {
  std::filesystem::path recording;  ///< recording.ream
  std::string case_name;            ///< where the case is, as for find_case(); empty: as recorded
  std::filesystem::path data;
  std::string rubric = "standard";  ///< of reports, as score::find_rubric
  std::string benchmark;            ///< of reports: file; empty: none
};

/// A kind of file that a session can become.
struct ExportFormat {
  std::string extension;  ///< ".pdf"
  std::string words;      ///< what the file is, for people
  std::string media_type;
  void (*write)(const ExportRequest& request, const std::filesystem::path& out, const Progress& progress);
};

/// All of them.
const std::vector<ExportFormat>& export_formats();

/// By the ending of a file's name. Error usage names all that there are.
const ExportFormat& export_format_of(const std::filesystem::path& out);

/// Writes one row a tick, as the trace.csv of a run is; the same bytes. Errors: invalid_input at damage, io.
void export_trace(const record::Recording& recording, const std::filesystem::path& csv);

/// Writes the surface that the session left, world frame, mm, by brick deltas; as the reamed.ply of a run.
/// `bone_case`: of the recording, see case_of(); its coverage becomes the reamed one.
void export_surface(const record::Recording& recording, case_::Case& bone_case,
                    const std::filesystem::path& ply);

}  // namespace ream::app
