#pragma once
#include <string>

namespace ream::log {

/// One line each on stderr, with time and level. Never called from the tick.
void info(const std::string& line);
void warn(const std::string& line);
void error(const std::string& line);

}  // namespace ream::log
