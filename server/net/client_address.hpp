#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "net/message.hpp"

namespace ream::net {

/// A network that proxies stand in: "10.0.0.7", "10.0.0.0/8", "2001:db8::/32".
struct TrustedProxy {
  std::array<uint8_t, 16> address{};  ///< IPv4 as ::ffff:a.b.c.d
  int bits = 128;
};

/// Error usage for text that is no address, or has bits that no such address has.
TrustedProxy trusted_proxy(const std::string& text);

/// Of which peers one believes for whom they ask.
class TrustedProxies {
 public:
  TrustedProxies() = default;
  explicit TrustedProxies(std::vector<TrustedProxy> proxies) : proxies_(std::move(proxies)) {}

  /// `address`: numeric.
  bool trusts(const std::string& address) const;

  /// Sets who has sent the request, as Request::peer, encrypted and passed_on say it. `peer` is connected.
  /// What the headers Forwarded, X-Forwarded-For and X-Forwarded-Proto say counts only when the peer is
  /// trusted: the client is the last one named that is no trusted proxy, or where that is no address, the
  /// proxy that named it. RequestError 400 when a trusted proxy passes on a Forwarded header that names
  /// another client than X-Forwarded-For: one of them is the client's own invention.
  void resolve(Request& request, const std::string& peer, bool encrypted) const;

 private:
  std::vector<TrustedProxy> proxies_;
};

/// What limits go by: whoever has an IPv6 address has its whole /64.
std::string limit_key(const std::string& address);

}  // namespace ream::net
