#pragma once
#include "bench/bench.hpp"

namespace ream::bench {

/// Micro-FE meshes against the thesis' chapter 2: its tables 2.1 to 2.5 and figure 2.4, memory, and speed of
/// writing.
std::vector<Row> femesh_suite(const Options& options);

}  // namespace ream::bench
