#pragma once
#include <array>
#include <cstdint>
#include <string>

#include "core/file_descriptor.hpp"
#include "openigtlink/telemetry_messages.hpp"

namespace ream::openigtlink {

/// A TCP port that clients connect to; never waits.
class ListeningSocket {
 public:
  /// `port` 0: any free one. Error unavailable, naming host and port, when it cannot be had; invalid_input
  /// for a host that is none of this machine.
  ListeningSocket(const std::string& host, uint16_t port);

  uint16_t port() const { return port_; }
  int descriptor() const { return socket_.get(); }
  /// Empty: nobody waits.
  FileDescriptor accept() const;

 private:
  FileDescriptor socket_;
  uint16_t port_ = 0;
};

/// One client: gets the newest message of every topic that it does not have yet, topics in turn, as fast as
/// it reads. Never waits; holds one message at a time. What a client sends is read and ignored.
class ClientConnection {
 public:
  ClientConnection(FileDescriptor socket, int64_t now_ns) : socket_(std::move(socket)), served_ns_(now_ns) {}

  /// A client that has taken nothing of what waits for it for so long is let go. While this program itself
  /// was held up, nobody's time is used up.
  static constexpr int64_t timeout_ns = 10'000'000'000;

  /// Writes what the client takes now; false: it has gone or its time is up. `now_ns` as steady_ns().
  bool serve(const MessageCache& cache, int64_t now_ns);

  int descriptor() const { return socket_.get(); }
  /// Whether something waits that it could not take.
  bool waits() const { return writing_ != nullptr; }

 private:
  bool drain_input();
  bool choose(const MessageCache& cache);

  FileDescriptor socket_;
  std::array<uint64_t, topic_count> sent_versions_{};
  size_t turn_ = 0;
  Message writing_;  ///< null: nothing
  size_t written_ = 0;
  int64_t served_ns_;      ///< when serve() was called last
  int64_t waited_ns_ = 0;  ///< since it last took something, or had nothing to take
};

}  // namespace ream::openigtlink
