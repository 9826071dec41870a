#pragma once
#include <unistd.h>

#include <cmath>
#include <iostream>
#include <string_view>

#include "core/interrupt.hpp"

namespace ream::app {

/// Tells a terminal how far the work is, and ends it when asked to. Leaves an empty line behind.
class TerminalProgress {
 public:
  TerminalProgress() : terminal_(::isatty(STDERR_FILENO) != 0) {}
  TerminalProgress(const TerminalProgress&) = delete;
  TerminalProgress& operator=(const TerminalProgress&) = delete;
  ~TerminalProgress() {
    if (terminal_) std::cerr << start_of_empty_line;
  }
  void operator()(double share, std::string_view step) const {
    throw_if_interrupted();
    if (terminal_) std::cerr << start_of_empty_line << std::lround(100.0 * share) << " % " << step;
  }

 private:
  static constexpr const char* start_of_empty_line = "\r\x1b[K";
  bool terminal_;
};

}  // namespace ream::app
