#pragma once
#include "bench/bench.hpp"

namespace ream::bench {

/// How warm five reamings of a sclerotic glenoid make the bone, dry and irrigated, beside those that were
/// measured in patients.
void add_heat_rows(const Options& options, std::vector<Row>& rows);

}  // namespace ream::bench
