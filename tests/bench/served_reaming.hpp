#pragma once
#include <memory>
#include <vector>

#include "api/running_session.hpp"
#include "bench/stream_viewer.hpp"
#include "sim/realtime.hpp"

namespace ream::bench {

/// How one served session went.
struct ServedTurn {
  api::LoopStatus loop;
  uint32_t ticks = 0;
  std::vector<uint64_t> missed_in_second;  ///< of the session, from its start on
  double streamed_mb = 0.0;
};

/// A server on loopback as `ream serve` makes one, the bench case thesis-5-4-2 in its data folder, and a
/// script that presses, pecks and presses again. Needs no network but 127.0.0.1.
class ServedReaming {
 public:
  ServedReaming(sim::Realtime realtime, double turn_s);
  ~ServedReaming();

  /// A new session from its first tick to its end, with the viewer watching.
  ServedTurn run(StreamViewer& viewer);

 private:
  struct House;
  std::unique_ptr<House> house_;
};

}  // namespace ream::bench
