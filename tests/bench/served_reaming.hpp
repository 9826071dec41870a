#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bench/stream_viewer.hpp"
#include "session/running_session.hpp"
#include "sim/realtime.hpp"

namespace ream::bench {

/// How one served session went.
struct ServedTurn {
  sim::LoopHealth loop;
  uint32_t ticks = 0;
  std::vector<uint64_t> missed_in_second;  ///< of the session, from its start on
  double streamed_mb = 0.0;
  double peak_memory_mb = 0.0;  ///< of the whole process, seen once a second
  int refusals = 0;             ///< of somebody who asked for the session's record once a second
};

/// What a server has besides the session.
enum class Surroundings {
  none,
  office,  ///< users, and 10,000 sessions; requests need a token
};

/// A server on loopback as `ream serve` makes one, the bench case thesis-5-4-2 in its data folder, and a
/// script that presses, pecks and presses again. Needs no network but 127.0.0.1.
class ServedReaming {
 public:
  ServedReaming(sim::Realtime realtime, double turn_s, Surroundings surroundings = Surroundings::none);
  ~ServedReaming();

  /// A new session from its first tick to its end, with the viewer watching. `beside` is called when it runs
  /// and returns at once.
  ServedTurn run(StreamViewer& viewer, const std::function<void(const Door&)>& beside = {});

 private:
  struct House;

  std::unique_ptr<House> house_;
};

}  // namespace ream::bench
