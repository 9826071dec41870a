#include "net/conditional.hpp"

#include "core/hash.hpp"
#include "net/problem.hpp"

namespace ream::net {
namespace {

constexpr std::string_view weak_mark = "W/";

/// Takes the next tag off `list`, quotes included; empty at its end and where it is no list of tags.
std::string_view next_tag(std::string_view& list) {
  const size_t begin = list.find_first_not_of(" \t,");
  if (begin == std::string_view::npos) return {};
  list.remove_prefix(begin);
  const size_t open = list.starts_with(weak_mark) ? weak_mark.size() : 0;
  if (open >= list.size() || list[open] != '"') return {};
  const size_t close = list.find('"', open + 1);
  if (close == std::string_view::npos) return {};
  const std::string_view tag = list.substr(0, close + 1);
  list.remove_prefix(close + 1);
  return tag;
}

std::string_view without_mark(std::string_view tag) {
  return tag.starts_with(weak_mark) ? tag.substr(weak_mark.size()) : tag;
}

}  // namespace

std::string entity_tag(std::span<const std::byte> bytes) { return "\"" + to_hex(hash_bytes(bytes)) + "\""; }

bool names_tag(std::string_view list, std::string_view tag) {
  if (list == "*") return true;
  for (auto known = next_tag(list); !known.empty(); known = next_tag(list))
    if (without_mark(known) == without_mark(tag)) return true;
  return false;
}

bool names_tag_strongly(std::string_view list, std::string_view tag) {
  if (list == "*") return true;
  for (auto known = next_tag(list); !known.empty(); known = next_tag(list))
    if (known == tag && !tag.starts_with(weak_mark)) return true;
  return false;
}

Response conditional(const Request& request, Response response) {
  const bool reads = request.method == "GET" || request.method == "HEAD";
  if (!reads || response.status != 200 || !response.body) return response;
  if (response.header("ETag").empty()) response.headers.emplace_back("ETag", entity_tag(*response.body));
  if (!names_tag(request.header("if-none-match"), response.header("ETag"))) return response;
  response.status = 304;
  response.body = nullptr;
  response.content_type.clear();
  return response;
}

bool require_match(const Request& request, std::string_view current) {
  if (!request.headers.contains("if-match")) return false;
  if (!names_tag_strongly(request.header("if-match"), current))
    throw RequestError(412, "it has changed since it was read; read it again and repeat the change");
  return true;
}

}  // namespace ream::net
