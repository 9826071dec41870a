#include "net/guard.hpp"

#include <arpa/inet.h>

#include <algorithm>
#include <cctype>
#include <string>

#include "net/problem.hpp"

namespace ream::net {
namespace {

std::string lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

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

bool same_origin(std::string_view origin, std::string_view host) {
  const std::string lower_origin = lower(origin), lower_host = lower(host);
  return lower_origin == "http://" + lower_host || lower_origin == "https://" + lower_host;
}

}  // namespace

bool is_loopback_host(std::string_view host) {
  const std::string name = lower(host);
  in_addr four{};
  if (inet_pton(AF_INET, name.c_str(), &four) == 1) return (ntohl(four.s_addr) >> 24) == 127;
  return name == "localhost" || name == "::1";
}

std::optional<Response> refuse_foreign(const Request& request, bool is_websocket) {
  const std::string_view host = request.header("host");
  if (!is_loopback_host(name_of_authority(host)))
    return problem(
        421,
        "the Host header must be localhost, 127.0.0.1 or [::1]: this server answers its own machine only");
  const bool reads_only = request.method == "GET" || request.method == "HEAD";
  const std::string_view origin = request.header("origin");
  if ((is_websocket || !reads_only) && !origin.empty() && !same_origin(origin, host))
    return problem(403, "requests from pages of another origin are refused: " + std::string(origin));
  return std::nullopt;
}

const std::vector<std::pair<std::string, std::string>>& security_headers() {
  static const std::vector<std::pair<std::string, std::string>> headers = {
      {"Content-Security-Policy",
       "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self' blob:; "
       "style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; connect-src 'self' blob: data:; "
       "object-src 'none'; base-uri 'none'; form-action 'self'; frame-ancestors 'none'"},
      {"X-Content-Type-Options", "nosniff"},
      {"Referrer-Policy", "no-referrer"},
      {"Cross-Origin-Opener-Policy", "same-origin"},
      {"Cross-Origin-Resource-Policy", "same-origin"}};
  return headers;
}

}  // namespace ream::net
