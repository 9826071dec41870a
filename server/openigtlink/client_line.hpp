#pragma once
#include <array>

#include "openigtlink/board.hpp"
#include "openigtlink/socket_handle.hpp"

namespace ream::openigtlink {

/// One client: gets the newest message of every topic that it does not have yet, topics in turn, as fast as
/// it reads. Never waits; holds one message at a time. What a client says is read and ignored.
class ClientLine {
 public:
  ClientLine(SocketHandle socket, int64_t now_ns) : socket_(std::move(socket)), served_ns_(now_ns) {}

  /// A client that has taken nothing of what waits for it for so long is let go. While this program itself
  /// was held up, nobody's patience is used up.
  static constexpr int64_t patience_ns = 10'000'000'000;

  /// Writes what the client takes now; false: it has gone or has lost our patience. `now_ns` as steady_ns().
  bool serve(const Board& board, int64_t now_ns);

  int descriptor() const { return socket_.get(); }
  /// Whether something waits that it could not take.
  bool waits() const { return writing_ != nullptr; }

 private:
  bool hear();
  bool choose(const Board& board);

  SocketHandle socket_;
  std::array<uint64_t, topic_count> has_{};  ///< editions
  size_t turn_ = 0;
  Message writing_;  ///< null: nothing
  size_t written_ = 0;
  int64_t served_ns_;      ///< when serve() was called last
  int64_t waited_ns_ = 0;  ///< since it last took something, or had nothing to take
};

}  // namespace ream::openigtlink
