#pragma once
#include <cstdint>

#include "bench/door.hpp"
#include "bench/side_process.hpp"

namespace ream::bench {

/// How requests to a server went.
struct RequestFigures {
  uint64_t asked = 0, failed = 0;  ///< failed: no answer, or a status that was not expected
  double duration_s = 0.0;
  double p50_ms = 0.0, p95_ms = 0.0, p99_ms = 0.0;  ///< from when each was due until its answer was complete
};

/// People and programs at work beside a session, in a process of their own: records, lists with filters,
/// metrics, cases, users, remarks and the page, asked at an even rate whatever the answers take; half of them
/// on connections of their own. Made before the program starts threads.
class RequestStream {
 public:
  RequestStream();

  /// Begins and returns. At most 10 minutes.
  void begin(const Door& door, double requests_per_s, double duration_s);
  /// Waits for the end. Error unavailable when the server could not be reached at all.
  RequestFigures end();

 private:
  SideProcess process_;
};

}  // namespace ream::bench
