#pragma once
#include <ostream>
#include <vector>

#include "bench/bench.hpp"
#include "gpu/queue.hpp"

namespace ream::bench {

/// Figure 3.5: bringing voxels from the device to the host by reading a buffer and by mapping it, for the
/// grids of table 3.3.
std::vector<Row> read_or_map(const gpu::Queue& queue, std::ostream* tables);

}  // namespace ream::bench
