#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "net/message.hpp"

namespace ream::net {

/// Whether only this machine reaches it there: 127.0.0.0/8, ::1 or "localhost".
bool is_loopback_host(std::string_view host);

/// What the Host header may name, besides this machine's loopback.
struct AcceptedHosts {
  const std::vector<std::string>&
      public_names;                  ///< host names in lower case, or addresses; see ListenOptions
  const std::string& local_address;  ///< of the connection's own end, numeric
};

/// A host name or numeric address as Host headers are compared with it: lower case, addresses in their
/// shortest form. Throws Error usage for anything else (a URL, a port, white space).
std::string plain_host(const std::string& name);

/// Refuses what a page of another site could make a browser send (DNS rebinding, cross-site requests): the
/// Host header must name this machine (421), and a request that changes something, or opens a WebSocket, must
/// carry no Origin or one equal to its Host (403): https for what came over TLS, http or https (that of a
/// proxy) otherwise. Nothing when the request may pass.
std::optional<Response> refuse_foreign(const Request& request, bool is_websocket, const AcceptedHosts& hosts);

bool wants_websocket(const Request& request);

/// Set on every response: content security policy (own scripts and styles, WebAssembly, blob workers), no
/// sniffing, no framing, no camera and the like; with TLS also that browsers come back with TLS only.
const std::vector<std::pair<std::string, std::string>>& security_headers(bool encrypted);

}  // namespace ream::net
