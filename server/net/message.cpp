#include "net/message.hpp"

#include <algorithm>

#include "core/json.hpp"
#include "core/log.hpp"
#include "net/problem.hpp"

namespace ream::net {
namespace {

int hex_value(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

std::string percent_decode(std::string_view text, bool plus_is_space) {
  std::string out;
  out.reserve(text.size());
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '+' && plus_is_space) {
      out += ' ';
    } else if (text[i] != '%') {
      out += text[i];
    } else {
      const int high = i + 2 < text.size() ? hex_value(text[i + 1]) : -1;
      const int low = high < 0 ? -1 : hex_value(text[i + 2]);
      if (low < 0) throw RequestError(400, "the address has a '%' that is not followed by two hex digits");
      out += static_cast<char>(high * 16 + low);
      i += 2;
    }
  }
  return out;
}

/// An encoded slash would make the decoded path ambiguous.
bool has_encoded_slash(std::string_view raw_path) {
  return raw_path.find("%2f") != std::string::npos || raw_path.find("%2F") != std::string::npos;
}

/// Such characters only serve to fool file systems and logs.
bool has_forbidden_character(std::string_view path) {
  return std::any_of(path.begin(), path.end(),
                     [](char c) { return static_cast<unsigned char>(c) < 32 || c == 127 || c == '\\'; });
}

bool is_token_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
         std::string_view("!#$%&'*+-.^_`|~").find(c) != std::string_view::npos;
}

bool is_name(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), is_token_letter);
}

bool is_value(std::string_view text) {
  return std::none_of(text.begin(), text.end(),
                      [](char c) { return (static_cast<unsigned char>(c) < 32 && c != '\t') || c == 127; });
}

void add_line(std::string& head, std::string_view name, std::string_view value) {
  if (!is_name(name) || !is_value(value)) {
    log::error("a reply's header was left out, for it holds control characters: " +
               std::string(is_name(name) ? name : "(its name)"));
    return;
  }
  head.append(name).append(": ").append(value).append("\r\n");
}

}  // namespace

SharedBytes share(std::string_view text) {
  const auto* data = reinterpret_cast<const std::byte*>(text.data());
  return std::make_shared<const Bytes>(data, data + text.size());
}

std::string_view Request::header(const std::string& name) const {
  const auto found = headers.find(name);
  return found == headers.end() ? std::string_view{} : std::string_view(found->second);
}

std::string_view Response::header(std::string_view name) const {
  for (const auto& [key, value] : headers)
    if (key == name) return value;
  return {};
}

Response bytes_response(int status, std::string content_type, SharedBytes body) {
  Response response;
  response.status = status;
  response.content_type = std::move(content_type);
  response.body = std::move(body);
  return response;
}

Response json_response(int status, const nlohmann::json& body) {
  // A name read from a file may hold broken UTF-8; a reply must not fail for that.
  const std::string text = body.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  Response response = bytes_response(status, "application/json", share(text));
  response.headers.emplace_back("Cache-Control", "no-store");
  return response;
}

void set_target(Request& request, std::string_view target) {
  if (target.empty() || target.front() != '/') throw RequestError(400, "the address must begin with '/'");
  const size_t mark = target.find('?');
  const std::string_view raw_path = target.substr(0, mark);
  request.path = percent_decode(raw_path, false);
  if (has_encoded_slash(raw_path) || has_forbidden_character(request.path))
    throw RequestError(400, "the address holds an encoded '/', a '\\' or a control character");
  if (mark == std::string_view::npos) return;
  std::string_view rest = target.substr(mark + 1);
  while (!rest.empty()) {
    const size_t end = rest.find('&');
    const std::string_view pair = rest.substr(0, end);
    const size_t equals = pair.find('=');
    const std::string_view value =
        equals == std::string_view::npos ? std::string_view{} : pair.substr(equals + 1);
    if (!pair.empty())
      request.query[percent_decode(pair.substr(0, equals), true)] = percent_decode(value, true);
    rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 1);
  }
}

std::string response_head(const Response& response,
                          const std::vector<std::pair<std::string, std::string>>& fixed, bool keep_alive) {
  std::string head =
      "HTTP/1.1 " + std::to_string(response.status) + " " + status_title(response.status) + "\r\n";
  for (const auto& [name, value] : response.headers) add_line(head, name, value);
  for (const auto& [name, value] : fixed)
    if (response.header(name).empty()) add_line(head, name, value);
  if (!response.content_type.empty()) add_line(head, "Content-Type", response.content_type);
  if (response.status != 204 && response.status != 304)
    add_line(head, "Content-Length", std::to_string(response.body_bytes()));
  if (!keep_alive) add_line(head, "Connection", "close");
  return head += "\r\n";
}

}  // namespace ream::net
