#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/progress.hpp"
#include "session/running_session.hpp"

namespace ream::session {

/// Which rows of a force trace are wanted.
struct TracePart {
  double from_s = 0.0;
  std::optional<double> to_s;  ///< none: to the end
  int stride = 1;              ///< every so many ticks
};

/// What is to be exported.
struct ExportOrder {
  SessionRequest session;           ///< with the labels that whoever asked may know
  TracePart part = {};              ///< of tables
  std::string rubric = "standard";  ///< of reports: "id" or "id@version"
  std::string benchmark = {};       ///< of reports: id; empty: none
};

/// A form in which a session can be had as a file.
struct ExportFormat {
  std::string name;  ///< what it is asked for by
  std::string media_type;
  bool is_table = false;  ///< rows of ticks, of which a part can be asked for
  /// Writes the file atomically from what lies in the session's folder. Errors: those of the recording and
  /// its case; io; cancelled.
  std::function<void(const ExportOrder& order, const std::filesystem::path& out, const Progress& progress)>
      write;
  std::string ending = {};  ///< of the file, without its dot; empty: the name
  bool is_report = false;   ///< judged by a rubric and compared with a benchmark
  /// Finds out in a moment what would make `write` fail at once; null: nothing would. Errors: not_found,
  /// invalid_input.
  std::function<void(const ExportOrder& order)> check = {};

  const std::string& file_ending() const { return ending.empty() ? name : ending; }
};

/// All forms of this server. Filled once, then only read.
class ExportFormats {
 public:
  void add(ExportFormat format) { formats_.push_back(std::move(format)); }
  /// Throws net::RequestError 422 that names those there are.
  const ExportFormat& find(const std::string& name) const;

 private:
  std::vector<ExportFormat> formats_;
};

}  // namespace ream::session
