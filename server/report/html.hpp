#pragma once
#include <string>

#include "report/report.hpp"

namespace ream::report {

/// One page that holds everything in itself (pictures, charts, style) and runs no scripts; to be read on a
/// screen or printed.
std::string html_of(const Report& report);

}  // namespace ream::report
