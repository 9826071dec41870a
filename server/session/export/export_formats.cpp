#include "session/export/export_formats.hpp"

#include "net/problem.hpp"

namespace ream::session {

const ExportFormat& ExportFormats::find(const std::string& name) const {
  std::string names;
  for (const ExportFormat& format : formats_) {
    if (format.name == name) return format;
    names += (names.empty() ? "" : ", ") + format.name;
  }
  throw net::RequestError(422, "sessions cannot be exported as '" + name + "'; there are " + names,
                          {{"#/format", "must be one of " + names}});
}

}  // namespace ream::session
