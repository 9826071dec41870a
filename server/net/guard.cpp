#include "net/guard.hpp"

#include <arpa/inet.h>

#include <algorithm>
#include <cctype>
#include <string>

#include "core/text.hpp"
#include "net/problem.hpp"

namespace ream::net {
namespace {

bool is_port(std::string_view text) {
  return !text.empty() && text.size() <= 5 &&
         std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

/// "localhost:8080" -> "localhost", "[::1]:8080" -> "::1"; empty when it is neither.
std::string_view name_of_authority(std::string_view authority) {
  if (!authority.empty() && authority.front() == '[') {
    const size_t close = authority.find(']');
    if (close == std::string_view::npos) return {};
    const std::string_view rest = authority.substr(close + 1);
    if (!rest.empty() && (rest.front() != ':' || !is_port(rest.substr(1)))) return {};
    return authority.substr(1, close - 1);
  }
  const size_t colon = authority.find(':');
  if (colon != std::string_view::npos && !is_port(authority.substr(colon + 1))) return {};
  return authority.substr(0, colon);
}

/// A numeric address in its shortest form; empty when it is none.
std::string canonical_address(const std::string& text) {
  char out[INET6_ADDRSTRLEN];
  in_addr four{};
  in6_addr six{};
  if (inet_pton(AF_INET, text.c_str(), &four) == 1) return inet_ntop(AF_INET, &four, out, sizeof out);
  if (inet_pton(AF_INET6, text.c_str(), &six) == 1) return inet_ntop(AF_INET6, &six, out, sizeof out);
  return {};
}

std::string canonical_host(std::string_view name) {
  const std::string plain = lower(name);
  const std::string address = canonical_address(plain);
  return address.empty() ? plain : address;
}

bool names_us(std::string_view name, const AcceptedHosts& hosts) {
  if (is_loopback_host(name)) return true;
  const std::string host = canonical_host(name);
  if (host.empty()) return false;
  return host == hosts.local_address ||
         std::find(hosts.public_names.begin(), hosts.public_names.end(), host) != hosts.public_names.end();
}

bool same_origin(std::string_view origin, const Request& request) {
  const std::string lower_origin = lower(origin), host = lower(request.header("host"));
  return lower_origin == "https://" + host || (!request.encrypted && lower_origin == "http://" + host);
}

using Headers = std::vector<std::pair<std::string, std::string>>;

Headers headers_of(bool encrypted) {
  Headers headers = {
      {"Content-Security-Policy",
       "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self' blob:; "
       "style-src 'self'; img-src 'self' data: blob:; connect-src 'self' blob: data:; "
       "object-src 'none'; base-uri 'none'; form-action 'self'; frame-ancestors 'none'"},
      {"Permissions-Policy",
       "accelerometer=(), camera=(), display-capture=(), geolocation=(), gyroscope=(), magnetometer=(), "
       "microphone=(), midi=(), payment=(), usb=()"},
      {"X-Content-Type-Options", "nosniff"},
      {"Referrer-Policy", "no-referrer"},
      {"Cross-Origin-Opener-Policy", "same-origin"},
      {"Cross-Origin-Resource-Policy", "same-origin"}};
  if (encrypted) headers.emplace_back("Strict-Transport-Security", "max-age=31536000");
  return headers;
}

}  // namespace

bool is_loopback_host(std::string_view host) {
  const std::string name = lower(host);
  in_addr four{};
  if (inet_pton(AF_INET, name.c_str(), &four) == 1) return (ntohl(four.s_addr) >> 24) == 127;
  return name == "localhost" || name == "::1";
}

std::string plain_host(const std::string& name) {
  const bool in_brackets = name.size() > 2 && name.front() == '[' && name.back() == ']';
  const std::string plain = canonical_host(in_brackets ? name.substr(1, name.size() - 2) : name);
  const bool is_name =
      plain.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789.-_") == std::string::npos;
  if (plain.empty() || (!is_name && canonical_address(plain).empty()))
    throw Error(ErrorKind::usage,
                "'" + name + "' is no host name and no address; give it without https:// and port");
  return plain;
}

std::optional<Response> refuse_foreign(const Request& request, bool is_websocket,
                                       const AcceptedHosts& hosts) {
  if (!names_us(name_of_authority(request.header("host")), hosts))
    return problem(
        421,
        "the Host header names another server: this one is reached as localhost, by the address it listens "
        "on, or by a name given with --public-name");
  const bool reads_only = request.method == "GET" || request.method == "HEAD";
  const std::string_view origin = request.header("origin");
  if ((is_websocket || !reads_only) && !origin.empty() && !same_origin(origin, request))
    return problem(403, "requests from pages of another origin are refused: " + std::string(origin));
  return std::nullopt;
}

bool wants_websocket(const Request& request) {
  return request.method == "GET" && lower(request.header("upgrade")) == "websocket";
}

const Headers& security_headers(bool encrypted) {
  static const Headers plain = headers_of(false), with_tls = headers_of(true);
  return encrypted ? with_tls : plain;
}

}  // namespace ream::net
