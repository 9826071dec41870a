#include "api/login_cookie.hpp"

#include <algorithm>

#include "net/problem.hpp"

namespace ream::api {
namespace {

constexpr std::string_view cookie_name = "ream_session", spaces = " \t";

std::string_view trimmed(std::string_view text) {
  const size_t begin = text.find_first_not_of(spaces);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(spaces) - begin + 1);
}

std::string cookie_line(std::string_view value, int64_t lifetime_s, bool encrypted) {
  return std::string(cookie_name) + "=" + std::string(value) +
         "; Path=/; HttpOnly; SameSite=Strict; Max-Age=" + std::to_string(lifetime_s) +
         (encrypted ? "; Secure" : "");
}

bool is_bearer(std::string_view scheme) {
  constexpr std::string_view bearer = "bearer";
  return std::equal(scheme.begin(), scheme.end(), bearer.begin(), bearer.end(),
                    [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a + 32 : a) == b; });
}

}  // namespace

std::string login_cookie(const access::Secret& secret, std::chrono::seconds lifetime, bool encrypted) {
  return cookie_line(secret.reveal(), lifetime.count(), encrypted);
}

std::string no_login_cookie(bool encrypted) { return cookie_line("", 0, encrypted); }

access::Secret cookie_of(const net::Request& request) {
  std::string_view rest = request.header("cookie");
  while (!rest.empty()) {
    const size_t end = std::min(rest.find(';'), rest.size());
    const std::string_view pair = trimmed(rest.substr(0, end));
    if (pair.starts_with(cookie_name) && pair.substr(cookie_name.size()).starts_with('='))
      return access::Secret(pair.substr(cookie_name.size() + 1));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return {};
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
