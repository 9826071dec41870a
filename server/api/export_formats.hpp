#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "api/running_session.hpp"
#include "core/progress.hpp"

namespace ream::api {

/// Which rows of a force trace are wanted.
struct TracePart {
  double from_s = 0.0;
  std::optional<double> to_s;  ///< none: to the end
  int stride = 1;              ///< every so many ticks
};

/// What is to be exported.
struct ExportOrder {
  SessionRequest session;  ///< with the labels that whoever asked may know
  TracePart part;          ///< of tables
};

/// A form in which a session can be had as a file.
struct ExportFormat {
  std::string name;  ///< also the file's ending, without its dot
  std::string media_type;
  bool is_table = false;  ///< rows of ticks, of which a part can be asked for
  /// Writes the file atomically from what lies in the session's folder. Errors: those of the recording and
  /// its case; io; cancelled.
  std::function<void(const ExportOrder& order, const std::filesystem::path& out, const Progress& progress)>
      write;
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

}  // namespace ream::api
