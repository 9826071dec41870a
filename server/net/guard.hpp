#pragma once
#include <optional>
#include <string_view>

#include "net/message.hpp"

namespace ream::net {

/// Whether a server without users may bind there: 127.0.0.0/8, ::1 or "localhost".
bool is_loopback_host(std::string_view host);

/// Refuses what a page of another site could make a browser send (DNS rebinding, cross-site requests): the
/// Host header must name this machine's loopback (421), and a request that changes something, or opens a
/// WebSocket, must carry no Origin or one equal to its Host (403). Nothing when the request may pass.
std::optional<Response> refuse_foreign(const Request& request, bool is_websocket);

/// Set on every response: content security policy (own scripts, WebAssembly, blob workers), no sniffing, no
/// framing.
const std::vector<std::pair<std::string, std::string>>& security_headers();

}  // namespace ream::net
