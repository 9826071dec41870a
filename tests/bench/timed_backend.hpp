#pragma once
#include "core/timing_histogram.hpp"
#include "sim/backend.hpp"

namespace ream::bench {

/// What the parts of a tick took, whenever they were called.
struct StageTimes {
  TimingHistogram contact, removal;
};

/// Puts a clock around the backend's narrow phase and removal. `times` must outlive it.
void time_stages(sim::Backend& backend, StageTimes& times);

}  // namespace ream::bench
