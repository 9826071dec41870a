#pragma once
#include "bench/bench.hpp"

namespace ream::bench {

/// What the machine itself allows a real-time thread, whatever the program does: how late it is woken, and
/// how much of its time its host (or the firmware) takes. Measured for a few seconds.
void add_machine_rows(std::vector<Row>& rows);

}  // namespace ream::bench
