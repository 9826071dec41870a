#pragma once
// Inside of net only: the two kinds of connection, each behind one function.
#include <boost/asio/ip/tcp.hpp>
#include <memory>

#include "net/engine.hpp"

namespace ream::net {

/// Serves requests on a socket whose executor is a strand of its own. `refuse`: answers 503 and ends.
void start_http(Engine& engine, boost::asio::ip::tcp::socket socket, bool refuse);

/// Answers the upgrade request and runs the session over the socket.
void start_websocket(Engine& engine, boost::asio::ip::tcp::socket socket, Request request,
                     std::unique_ptr<WebSocketSession> session);

}  // namespace ream::net
