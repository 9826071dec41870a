#pragma once
#include <string>

#include "report/report.hpp"

namespace ream::report {

/// The bytes of a PDF file: A4, fonts embedded, pages numbered. The same report gives the same bytes on the
/// same machine. Error unavailable when no page can be drawn.
std::string pdf_of(const Report& report);

}  // namespace ream::report
