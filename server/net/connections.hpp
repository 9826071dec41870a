#pragma once
// Inside of net only: the two kinds of connection, each behind one function.
#include <memory>

#include "net/channel.hpp"
#include "net/engine.hpp"

namespace ream::net {

/// Who is connected and through which of our addresses; numeric, without ports.
struct Ends {
  std::string peer, local;
  std::string peer_key;  ///< what limits go by: the peer, of IPv6 its /64
};

Ends ends_of(const Channel::Socket& socket);

/// Serves requests on a socket whose executor is a strand of its own. `refuse`: answers 503 and ends.
void start_http(Engine& engine, Channel::Socket socket, Ends ends, bool refuse);

/// Answers the upgrade request and runs the session over the channel.
void start_websocket(Engine& engine, Channel channel, Ends ends, Request request,
                     std::unique_ptr<WebSocketSession> session);

}  // namespace ream::net
