#include "api/json_page.hpp"

#include <algorithm>

#include "api/request_values.hpp"
#include "core/error.hpp"
#include "core/json.hpp"
#include "core/text.hpp"

namespace ream::api {
using nlohmann::json;
namespace {

constexpr char digits[] = "0123456789abcdef";

bool is_plain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '.' ||
         c == '_' || c == '~';
}

std::string encoded(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    out += is_plain(c) ? std::string(1, c) : std::string{'%', digits[byte >> 4], digits[byte & 15]};
  }
  return out;
}

/// What a list is sorted by: the value of a key, then the id, both the same way.
struct Order {
  std::string key;
  bool descending = false;

  bool precedes(const json& a, const json& b) const {
    const int first = a.at(key) == b.at(key) ? 0 : a.at(key) < b.at(key) ? -1 : 1;
    if (first != 0) return descending ? first > 0 : first < 0;
    return descending ? a.at("id") > b.at("id") : a.at("id") < b.at("id");
  }
  /// Says where a list goes on; of another order it fits nothing.
  std::string cursor_of(const json& item) const {
    return hex_of(json::array({descending ? "-" + key : key, item.at(key), item.at("id")}).dump());
  }
};

/// An item that stands where the cursor does.
json place_of(const std::string& cursor, const Order& order) {
  const json place = parse_json_or_discard(bytes_from_hex(cursor));
  if (!place.is_array() || place.size() != 3 || place[0] != (order.descending ? "-" + order.key : order.key))
    throw Error(ErrorKind::invalid_input,
                "cursor is none that this list has given; leave it out to begin with the first page");
  return {{order.key, place[1]}, {"id", place[2]}};
}

}  // namespace

size_t limit_of(const net::Request& request) {
  const auto given = request.query.find("limit");
  return given == request.query.end() ? default_page_size : parse_json(given->second).get<size_t>();
}

std::string next_link(const net::Request& request, const std::string& cursor) {
  std::string query;
  for (const auto& [name, value] : request.query)
    if (name != "cursor") query += encoded(name) + "=" + encoded(value) + "&";
  return "<" + request.path + "?" + query + "cursor=" + encoded(cursor) + ">; rel=\"next\"";
}

net::Response page_response(const net::Request& request, const std::string& name, json items,
                            const std::string& next, size_t total) {
  net::Response response = net::json_response(
      200, {{name, std::move(items)}, {"next", next.empty() ? json(nullptr) : json(next)}, {"total", total}});
  if (!next.empty()) response.headers.emplace_back("Link", next_link(request, next));
  return response;
}

net::Response page_of(const net::Request& request, const std::string& name, std::vector<json> items,
                      const std::string& default_sort) {
  const std::string sort = query_text(request, "sort", default_sort),
                    cursor = query_text(request, "cursor", "");
  const Order order{sort.starts_with('-') ? sort.substr(1) : sort, sort.starts_with('-')};
  const size_t limit = limit_of(request), total = items.size();
  std::sort(items.begin(), items.end(), [&](const json& a, const json& b) { return order.precedes(a, b); });
  if (!cursor.empty()) {
    const json place = place_of(cursor, order);
    items.erase(items.begin(), std::find_if(items.begin(), items.end(),
                                            [&](const json& item) { return order.precedes(place, item); }));
  }
  std::string next;
  if (items.size() > limit) {
    next = order.cursor_of(items[limit - 1]);
    items.resize(limit);
  }
  return page_response(request, name, std::move(items), next, total);
}

}  // namespace ream::api
