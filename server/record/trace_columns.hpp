#pragma once
#include <span>
#include <string_view>

namespace ream::record {

/// A column of trace.csv. The last letters of its name are its unit.
struct TraceColumn {
  std::string_view name, unit;  ///< unit "" where there is none
  std::string_view meaning;     ///< a sentence for people
};

/// In the file's order.
std::span<const TraceColumn> trace_columns();

}  // namespace ream::record
