#pragma once
#include <cstdint>

#include "bench/door.hpp"
#include "bench/side_process.hpp"

namespace ream::bench {

/// What a crowd did to a server.
struct HostileFigures {
  uint64_t connections = 0;  ///< that were begun
  uint64_t held = 0;         ///< at the most at once, as the crowd sees it
  uint64_t attacks = 0;      ///< bodies, headers and WebSockets tried
  double sent_mb = 0.0;
};

/// Peers that wish a server ill, in a process of their own: 1,000 connections that say nothing or a header
/// byte by byte, bodies of 100 MB, headers without an end, and WebSockets of a session that send nonsense.
/// Made before the program starts threads.
class HostileCrowd {
 public:
  HostileCrowd();

  /// Begins and returns. The door's token lets the nonsense get as far as the streams.
  void begin(const Door& door, double duration_s);
  HostileFigures end();

 private:
  SideProcess process_;
};

}  // namespace ream::bench
