#include <charconv>
#include <cstdint>

#include "api/access_resource.hpp"
#include "core/json.hpp"
#include "net/problem.hpp"

namespace ream::api {
using nlohmann::json;
namespace {

constexpr int usual_page = 50, longest_page = 500;

/// A whole number from 1 to `most`; `otherwise` when it is not in the query.
int64_t number_in(const net::Request& request, const std::string& key, int64_t most, int64_t otherwise) {
  const auto given = request.query.find(key);
  if (given == request.query.end()) return otherwise;
  const std::string& text = given->second;
  int64_t number = 0;
  const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (failed != std::errc() || end != text.data() + text.size() || number < 1 || number > most)
    throw net::RequestError(422, "?" + key + " must be a whole number from 1 to " + std::to_string(most));
  return number;
}

json audit_json(const store::AuditRow& row) {
  return {{"number", row.number},   {"at_utc", row.at_utc}, {"user_id", row.user_id},
          {"name", row.name},       {"role", row.role},     {"credential", row.credential},
          {"address", row.address}, {"action", row.action}, {"object", row.object},
          {"detail", row.detail}};
}

net::Response list(const AccessTools& tools, const net::Request& request) {
  const auto most = static_cast<int>(number_in(request, "limit", longest_page, usual_page));
  const int64_t before = number_in(request, "before", INT64_MAX, INT64_MAX);
  json entries = json::array();
  json next;
  if (tools.gatehouse) {
    auto rows = tools.gatehouse->audit.list(before, most + 1);
    if (rows.size() > static_cast<size_t>(most)) {
      rows.pop_back();
      next = rows.back().number;
    }
    for (const auto& row : rows) entries.push_back(audit_json(row));
  }
  return net::json_response(200, {{"entries", std::move(entries)}, {"next", std::move(next)}});
}

}  // namespace

void add_audit_routes(net::Router& router, const AccessTools& tools) {
  router.on("GET", "/api/v1/audit", [tools](const net::Request& request) { return list(tools, request); });
}

}  // namespace ream::api
