#pragma once
#include <string>

namespace ream::log {

/// One line each on stderr, with time and level. Never called from the tick.
void info(const std::string& line);
void warn(const std::string& line);
void error(const std::string& line);

/// For a catch (...) beyond which nothing may escape: one line, "<what>: <the exception's words>". Without
/// memory for it there is no line.
void current_exception(const char* what) noexcept;

}  // namespace ream::log
