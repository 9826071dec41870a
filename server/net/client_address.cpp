#include "net/client_address.hpp"

#include <arpa/inet.h>

#include <algorithm>
#include <charconv>

#include "core/error.hpp"
#include "core/text.hpp"
#include "net/problem.hpp"

namespace ream::net {
namespace {

using Bits = std::array<uint8_t, 16>;
constexpr int bits_of_ipv4_prefix = 96;

std::optional<Bits> bits_of(const std::string& address) {
  Bits bits{};
  if (inet_pton(AF_INET6, address.c_str(), bits.data()) == 1) return bits;
  if (inet_pton(AF_INET, address.c_str(), bits.data() + 12) != 1) return std::nullopt;
  bits[10] = bits[11] = 0xff;
  return bits;
}

bool is_ipv4(const Bits& bits) {
  constexpr Bits mapped{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xff, 0xff};
  return std::equal(bits.begin(), bits.begin() + 12, mapped.begin());
}

std::string text_of_bits(const Bits& bits) {
  char text[INET6_ADDRSTRLEN];
  return is_ipv4(bits) ? inet_ntop(AF_INET, bits.data() + 12, text, sizeof text)
                       : inet_ntop(AF_INET6, bits.data(), text, sizeof text);
}

std::string_view without_spaces(std::string_view text) {
  const size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

/// Parts between `separator`s outside of double quotes.
std::vector<std::string_view> parts_of(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  bool quoted = false;
  size_t begin = 0;
  for (size_t at = 0; at < text.size(); ++at) {
    if (text[at] == '"') quoted = !quoted;
    if (text[at] != separator || quoted) continue;
    parts.push_back(without_spaces(text.substr(begin, at - begin)));
    begin = at + 1;
  }
  parts.push_back(without_spaces(text.substr(begin)));
  return parts;
}

/// "1.2.3.4", "1.2.3.4:5", "[2001:db8::1]:5", "2001:db8::1", each perhaps in quotes; empty for anything else.
std::string address_in(std::string_view node) {
  if (node.size() >= 2 && node.front() == '"' && node.back() == '"') node = node.substr(1, node.size() - 2);
  if (node.starts_with('[')) {
    const size_t close = node.find(']');
    node = close == std::string_view::npos ? "" : node.substr(1, close - 1);
  } else if (std::count(node.begin(), node.end(), ':') == 1) {
    node = node.substr(0, node.find(':'));
  }
  const auto bits = bits_of(std::string(node));
  return bits ? text_of_bits(*bits) : std::string();
}

/// One proxy's word: for whom it asks, and how that one came to it.
struct Hop {
  std::string client;  ///< empty: it does not say, or not as an address
  std::string scheme;  ///< "http", "https" or empty
};

std::vector<Hop> hops_of_forwarded(std::string_view header) {
  std::vector<Hop> hops;
  for (const std::string_view element : parts_of(header, ',')) {
    Hop hop;
    for (const std::string_view pair : parts_of(element, ';')) {
      const size_t equals = std::min(pair.find('='), pair.size());
      const std::string name = lower(pair.substr(0, equals));
      const std::string_view value = pair.substr(std::min(equals + 1, pair.size()));
      if (name == "for") hop.client = address_in(value);
      if (name == "proto") hop.scheme = lower(value);
    }
    hops.push_back(hop);
  }
  return hops;
}

/// A scheme goes with each hop where there are as many, else the last one with all.
std::vector<Hop> hops_of_x_forwarded(std::string_view clients, std::string_view schemes) {
  std::vector<Hop> hops;
  const auto said = parts_of(schemes, ',');
  const auto named = parts_of(clients, ',');
  for (size_t i = 0; i < named.size(); ++i)
    hops.push_back({address_in(named[i]), lower(said.size() == named.size() ? said[i] : said.back())});
  return hops;
}

bool says_passed_on(const Request& request) {
  for (const char* name : {"forwarded", "via", "x-real-ip", "x-client-ip", "client-ip", "true-client-ip",
                           "cf-connecting-ip", "x-cluster-client-ip"})
    if (request.headers.contains(name)) return true;
  const auto from = request.headers.lower_bound("x-forwarded");
  return from != request.headers.end() && from->first.starts_with("x-forwarded");
}

}  // namespace

TrustedProxy trusted_proxy(const std::string& text) {
  const size_t slash = text.find('/');
  const auto bits = bits_of(text.substr(0, slash));
  const int most = bits && is_ipv4(*bits) && text.find(':') == std::string::npos ? 32 : 128;
  int wanted = most;
  if (slash != std::string::npos) {
    const char* end = text.data() + text.size();
    const auto read = std::from_chars(text.data() + slash + 1, end, wanted);
    if (read.ec != std::errc() || read.ptr != end) wanted = -1;
  }
  if (!bits || wanted < 0 || wanted > most)
    throw Error(ErrorKind::usage,
                "--trusted-proxy " + text +
                    ": give the address of a proxy, or of a network of proxies as ADDRESS/BITS");
  return {*bits, most == 32 ? bits_of_ipv4_prefix + wanted : wanted};
}

bool TrustedProxies::trusts(const std::string& address) const {
  const auto bits = bits_of(address);
  return bits && std::any_of(proxies_.begin(), proxies_.end(), [&](const TrustedProxy& proxy) {
           const auto whole = static_cast<size_t>(proxy.bits / 8);
           if (!std::equal(bits->begin(), bits->begin() + static_cast<std::ptrdiff_t>(whole),
                           proxy.address.begin()))
             return false;
           const int rest = proxy.bits % 8;
           return rest == 0 || ((*bits)[whole] ^ proxy.address[whole]) >> (8 - rest) == 0;
         });
}

void TrustedProxies::resolve(Request& request, const std::string& peer, bool encrypted) const {
  request.peer = peer;
  request.encrypted = encrypted;
  request.passed_on = says_passed_on(request);
  if (!trusts(peer)) return;
  request.passed_on = true;
  /// The last hop that somebody trusted speaks of, and what it says of the scheme.
  const auto resolved = [&](const std::vector<Hop>& hops) {
    Hop client{peer, {}};
    for (auto hop = hops.rbegin(); hop != hops.rend() && trusts(client.client); ++hop) {
      client.scheme = hop->scheme;
      if (hop->client.empty()) break;
      client.client = hop->client;
    }
    return client;
  };
  const std::string_view forwarded = request.header("forwarded"), x_for = request.header("x-forwarded-for"),
                         x_proto = request.header("x-forwarded-proto");
  Hop client{peer, lower(parts_of(x_proto, ',').back())};
  if (!x_for.empty()) client = resolved(hops_of_x_forwarded(x_for, x_proto));
  if (!forwarded.empty()) {
    const Hop standard = resolved(hops_of_forwarded(forwarded));
    const bool other_client = !x_for.empty() && standard.client != client.client;
    const bool other_scheme =
        !standard.scheme.empty() && !client.scheme.empty() && standard.scheme != client.scheme;
    if (other_client || other_scheme)
      throw RequestError(
          400,
          "the headers Forwarded and X-Forwarded-For name different clients; the proxy must set "
          "both or take out what clients send");
    client = {standard.client, standard.scheme.empty() ? client.scheme : standard.scheme};
  }
  request.peer = client.client;
  request.encrypted = encrypted || client.scheme == "https";
}

std::string limit_key(const std::string& address) {
  auto bits = bits_of(address);
  if (!bits || is_ipv4(*bits)) return address;
  std::fill(bits->begin() + 8, bits->end(), uint8_t{0});
  return text_of_bits(*bits) + "/64";
}

}  // namespace ream::net
