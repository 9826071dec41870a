#pragma once
#include <cstdint>
#include <string>

#include "openigtlink/socket_handle.hpp"

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
  SocketHandle accept() const;

 private:
  SocketHandle socket_;
  uint16_t port_ = 0;
};

}  // namespace ream::openigtlink
