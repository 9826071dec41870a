#include "net/response_head.hpp"

#include <algorithm>

#include "core/log.hpp"
#include "net/problem.hpp"

namespace ream::net {
namespace {

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
