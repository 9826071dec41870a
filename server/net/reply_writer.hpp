#pragma once
// Inside of net only.
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "net/channel.hpp"
#include "net/engine.hpp"
#include "net/transfer_pace.hpp"
#include "net/watchdog.hpp"

namespace ream::net {

/// Sends one reply after another over a connection's channel: the head, then bytes of memory, or those of a
/// file piece by piece. A peer that does not take them is cut. Runs on the channel's strand.
class ReplyWriter {
 public:
  ReplyWriter(Engine& engine, Channel& channel, Watchdog& watchdog)
      : engine_(engine), channel_(channel), watchdog_(watchdog) {}

  struct Order {
    std::weak_ptr<void> owner;  ///< holds writer, channel and watchdog; is kept alive on the way
    std::string head;
    SharedBytes body;
    std::optional<FileStretch> file;
    std::function<void()> done;  ///< called when all has left, not at all when it could not
  };
  void send(Order order);

 private:
  void write_some();
  void fetch_piece();
  bool read_piece();
  void finish();

  Engine& engine_;
  Channel& channel_;
  Watchdog& watchdog_;
  Order order_;  ///< its file is what has not been read yet
  Bytes piece_;
  std::array<boost::asio::const_buffer, 2> leaving_;  ///< of head and body, or of piece_
  TransferPace pace_;
};

}  // namespace ream::net
