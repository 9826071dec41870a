#include <cstdint>

#include "api/json_page.hpp"
#include "api/request_values.hpp"
#include "api/routes.hpp"
#include "api/services.hpp"
#include "core/json.hpp"

namespace ream::api {
using nlohmann::json;
namespace {

json audit_json(const store::AuditRow& row) {
  return {{"number", row.number},   {"at_utc", row.at_utc}, {"user_id", row.user_id},
          {"name", row.name},       {"role", row.role},     {"credential", row.credential},
          {"address", row.address}, {"action", row.action}, {"object", row.object},
          {"detail", row.detail}};
}

net::Response list_audit(const Services& services, const net::Request& request) {
  const auto most = static_cast<int>(limit_of(request));
  const std::string given = query_text(request, "before");
  const int64_t before = given.empty() ? INT64_MAX : parse_json(given).get<int64_t>();
  json entries = json::array();
  json next;
  auto rows = services.access_control.audit.list(before, most + 1);
  if (rows.size() > static_cast<size_t>(most)) {
    rows.pop_back();
    next = rows.back().number;
  }
  for (const auto& row : rows) entries.push_back(audit_json(row));
  return net::json_response(200, {{"entries", std::move(entries)}, {"next", std::move(next)}});
}

}  // namespace

std::vector<Route> audit_routes() {
  return {{"GET", "/api/v1/audit", access::operators, reads("audit.read"), list_audit}};
}

}  // namespace ream::api
