#pragma once
#include <cstdint>

#include "bench/door.hpp"
#include "bench/side_process.hpp"

namespace ream::bench {

/// A viewer without a screen, in a process of its own: it receives everything that a session streams and
/// throws it away. Made before the program starts threads.
class StreamViewer {
 public:
  StreamViewer();

  /// Joins the stream of a session of a server on 127.0.0.1. Returns when it has been greeted.
  void watch(const Door& door);
  /// Bytes received since. Error unavailable when the stream broke.
  uint64_t stop_watching();

 private:
  SideProcess process_;
};

}  // namespace ream::bench
