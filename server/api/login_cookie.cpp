#include "api/login_cookie.hpp"

#include <algorithm>

#include "net/problem.hpp"

namespace ream::api {
namespace {

constexpr std::string_view session_cookie = "ream_session", browser_cookie = "ream_device", spaces = " \t";
constexpr auto device_lifetime = std::chrono::seconds(std::chrono::hours(24 * 90));

std::string_view trimmed(std::string_view text) {
  const size_t begin = text.find_first_not_of(spaces);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(spaces) - begin + 1);
}

/// RFC 6265bis, 4.1.3: names that browsers take over TLS only, from this host alone.
std::string session_name(bool encrypted) {
  return (encrypted ? "__Host-" : "") + std::string(session_cookie);
}
std::string device_name(bool encrypted) {
  return (encrypted ? "__Secure-" : "") + std::string(browser_cookie);
}

std::string cookie_line(const std::string& name, std::string_view value, const char* path,
                        std::chrono::seconds lifetime, bool encrypted) {
  return name + "=" + std::string(value) + "; Path=" + path +
         "; HttpOnly; SameSite=Strict; Max-Age=" + std::to_string(lifetime.count()) +
         (encrypted ? "; Secure" : "");
}

access::Secret cookie_named(const net::Request& request, const std::string& name) {
  std::string_view rest = request.header("cookie");
  while (!rest.empty()) {
    const size_t end = std::min(rest.find(';'), rest.size());
    const std::string_view pair = trimmed(rest.substr(0, end));
    if (pair.starts_with(name) && pair.substr(name.size()).starts_with('='))
      return access::Secret(pair.substr(name.size() + 1));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return {};
}

bool is_bearer(std::string_view scheme) {
  constexpr std::string_view bearer = "bearer";
  return std::equal(scheme.begin(), scheme.end(), bearer.begin(), bearer.end(),
                    [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a + 32 : a) == b; });
}

}  // namespace

std::string login_cookie(const access::Secret& secret, std::chrono::seconds lifetime, bool encrypted) {
  return cookie_line(session_name(encrypted), secret.reveal(), "/", lifetime, encrypted);
}

std::string no_login_cookie(bool encrypted) {
  return cookie_line(session_name(encrypted), "", "/", std::chrono::seconds(0), encrypted);
}

access::Secret cookie_of(const net::Request& request) {
  return cookie_named(request, session_name(request.encrypted));
}

std::string device_cookie(const access::Secret& secret, bool encrypted) {
  return cookie_line(device_name(encrypted), secret.reveal(), "/api/v1/login", device_lifetime, encrypted);
}

access::Secret device_of(const net::Request& request) {
  access::Secret shown = cookie_named(request, device_name(request.encrypted));
  return access::id_inside(shown).empty() ? access::Secret() : shown;
}

access::Secret bearer_token_of(const net::Request& request) {
  const std::string_view shown = trimmed(request.header("authorization"));
  if (shown.empty()) return {};
  const size_t space = shown.find(' ');
  const std::string_view token = space == std::string_view::npos ? "" : trimmed(shown.substr(space));
  if (!is_bearer(shown.substr(0, space)) || token.empty())
    refuse_unknown("the Authorization header must be \"Bearer\" and a token", "invalid_request");
  return access::Secret(token);
}

void refuse_unknown(const std::string& detail, const std::string& error) {
  throw net::RequestError(
      401, detail, {},
      {{"WWW-Authenticate", "Bearer realm=\"ream\"" + (error.empty() ? "" : ", error=\"" + error + "\"")}});
}

}  // namespace ream::api
