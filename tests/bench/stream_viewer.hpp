#pragma once
#include <sys/types.h>

#include <cstdint>
#include <string>

namespace ream::bench {

/// A viewer without a screen, in a process of its own: it receives everything that a session streams and
/// throws it away. Made before the program starts threads.
class StreamViewer {
 public:
  StreamViewer();
  ~StreamViewer();
  StreamViewer(const StreamViewer&) = delete;
  StreamViewer& operator=(const StreamViewer&) = delete;

  /// Joins the stream of a session of the server on that port of 127.0.0.1. Returns when it has been greeted.
  void watch(uint16_t port, const std::string& session);
  /// Bytes received since. Error unavailable when the stream broke.
  uint64_t stop_watching();

 private:
  int to_child_ = -1, from_child_ = -1;
  pid_t child_ = -1;
};

}  // namespace ream::bench
