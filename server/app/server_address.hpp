#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "net/listener.hpp"
#include "openigtlink/server.hpp"

namespace ream::app {

/// Where a server is to be reached, as the command line says.
struct ServerAddress {
  std::string host = "127.0.0.1";
  uint16_t port = 8080;
  std::vector<std::string> public_names;         ///< besides the host and this machine's own name
  std::filesystem::path certificate_chain, key;  ///< empty: without TLS
  std::vector<std::string> trusted_proxies;      ///< as on the command line
  bool insecure = false;                         ///< others may send their passwords in the clear
};

/// What the listener has to know. `has_users`: whether people have to log in. Error usage, in words that say
/// what to do, when others could reach the server without a login, or with one that everybody on their way
/// can read; those of net::TlsContext.
net::ListenOptions listen_options(const ServerAddress& address, bool has_users);

/// The page's address for people, without a slash at its end. `port`: that was bound.
std::string server_url(const ServerAddress& address, uint16_t port);

/// Where to listen for OpenIGTLink, of `[HOST:]PORT` (an IPv6 host in brackets); the host is the server's
/// unless it is said. Error usage, in words that say what to do, for other text, and beyond loopback without
/// --insecure: the protocol knows neither logins nor encryption.
openigtlink::ServerOptions openigtlink_address(const std::string& text, const ServerAddress& server);

}  // namespace ream::app
