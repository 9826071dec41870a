#pragma once
#include <string>

namespace ream::log {

/// One line each on stderr, with time and level. Never called from the tick.
void info(const std::string& line);
void warn(const std::string& line);
void error(const std::string& line);

/// How lines look on stderr.
enum class Format {
  automatic,  ///< journal where stderr is systemd's journal, else text
  text,       ///< "2026-01-31 12:00:00.000 warning ..."
  journal,    ///< "<4>...": the journal keeps time and level itself
  json        ///< {"time":"2026-01-31T12:00:00.000Z","level":"warning","text":"..."}
};

/// From the next line on; before the first call: automatic.
void set_format(Format format);

/// For a catch (...) beyond which nothing may escape: one line, "<what>: <the exception's words>". Without
/// memory for it there is no line.
void current_exception(const char* what) noexcept;

}  // namespace ream::log
