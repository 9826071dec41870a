#pragma once
#include <string>

#include "app/server_address.hpp"
#include "openigtlink/server.hpp"

namespace ream::app {

/// Where to listen, of `[HOST:]PORT` (an IPv6 host in brackets); the host is the server's unless it is said.
/// Error usage, in words that say what to do, for other text, and beyond loopback without --insecure: the
/// protocol knows neither logins nor encryption.
openigtlink::ServerOptions openigtlink_address(const std::string& text, const ServerAddress& server);

}  // namespace ream::app
