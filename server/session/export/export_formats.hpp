#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/progress.hpp"
#include "record/recording.hpp"
#include "score/benchmark.hpp"
#include "score/rubric.hpp"
#include "session/running_session.hpp"

namespace ream::session {

/// Which rows of a force trace are wanted.
struct TracePart {
  double from_s = 0.0;
  std::optional<double> to_s;  ///< none: to the end
  int stride = 1;              ///< every so many ticks
};

/// What somebody who names no files of this machine wants exported: sessions, rubrics and benchmarks go by
/// their ids.
struct ExportOrder {
  SessionRequest session;           ///< with the labels that whoever asked may know
  TracePart part = {};              ///< of tables
  std::string rubric = "standard";  ///< of reports: "id" or "id@version"
  std::string benchmark = {};       ///< of reports: id; empty: none
  bool component_load = false;      ///< of reports: with a page of a component under load
};

/// What is to be exported, and what it needs beside the recording.
struct ExportRequest {
  std::filesystem::path recording;  ///< recording.ream
  std::string case_name;            ///< where the case is, as for find_case(); empty: as recorded
  std::filesystem::path data;
  std::optional<score::Rubric> rubric;        ///< of reports; none: the newest standard one
  std::optional<score::Benchmark> benchmark;  ///< of reports
  bool component_load = false;                ///< of reports
  TracePart part;                             ///< of tables
  std::filesystem::path page = {};            ///< of review files: as page_folder()
  std::optional<SessionRequest> labels;       ///< trainee, title and so on; none: as in session.json
};

/// What more can be said of an export.
enum class ExportKind {
  plain,
  table,   ///< of a part of the ticks
  report,  ///< with a rubric, a benchmark and a component under load
  pair,    ///< a second file is written beside the first
  local    ///< not in a server: HDF5's library ends the process where memory is short
};

/// A kind of file that a session can become.
struct ExportFormat {
  std::string name;       ///< "pdf"
  std::string extension;  ///< ".pdf"
  std::string words;      ///< what the file is, for people
  std::string media_type;
  ExportKind kind;
  /// Writes it, atomically. Errors: those of the recording and its case; io; cancelled.
  void (*write)(const ExportRequest& request, const std::filesystem::path& out, const Progress& progress);

  /// Of the file, without its dot.
  std::string ending() const { return extension.substr(1); }
  bool is_table() const { return kind == ExportKind::table; }
  bool is_report() const { return kind == ExportKind::report; }
};

/// All of them. Where a file has the endings of several, it is the first of them.
const std::vector<ExportFormat>& export_formats();

/// By its name, or with an empty one by the ending of a file. Error usage names all that there are.
const ExportFormat& export_format_of(const std::string& name, const std::filesystem::path& out);

/// By its name, of those that are one file, which a server can make and send. Throws net::RequestError 422
/// that names those there are.
const ExportFormat& served_export_format(const std::string& name);

/// Deviations alone (score/deviation_file.hpp), in the order of the vertices of the bone in the PLY files. As
/// ExportFormat::write.
void write_deviations(const ExportRequest& request, const std::filesystem::path& out,
                      const Progress& progress);

/// The recording of a request, which may be damaged towards its end; that is logged.
record::Recording recording_of(const ExportRequest& request);

}  // namespace ream::session
