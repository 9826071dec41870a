#pragma once
#include <span>

#include "tables/column_batch.hpp"

namespace ream::record {

/// A column of trace.csv. The last letters of its name are its unit.
using TraceColumn = tables::Column;

/// In the file's order.
std::span<const TraceColumn> trace_columns();

}  // namespace ream::record
