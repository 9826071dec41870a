#include <charconv>
#include <contract.hpp>
#include <nlohmann/json.hpp>

#include "api/prometheus.hpp"
#include "api/request_values.hpp"
#include "api/routes.hpp"
#include "api/services.hpp"

namespace ream::api {
namespace {

net::Response get_health(const Services&, const net::Request&) {
  return net::json_response(200, {{"status", "ok"}});
}

net::Response get_readiness(const Services& services, const net::Request&) {
  services.readiness.require_ready();
  services.database_watch.require_there();
  nlohmann::json view = {{"status", "ready"}};
  if (const std::string held = services.retention.held(); !held.empty()) view["retention_held"] = held;
  return net::json_response(200, view);
}

net::Response get_gauges(const Services& services, const net::Request&) {
  return net::bytes_response(200, "text/plain; version=0.0.4; charset=utf-8",
                             net::share(prometheus_text(services.sessions.held())));
}

net::Response get_contract(const Services&, const net::Request&) {
  return net::bytes_response(200, "application/yaml", net::share(embedded::contract::find("openapi.yaml")));
}

std::unique_ptr<net::WebSocketSession> listen_to_changes(const Services& services,
                                                         const net::Request& request) {
  std::optional<uint64_t> since;
  if (const std::string text = query_text(request, "since"); !text.empty())
    std::from_chars(text.data(), text.data() + text.size(), since.emplace(0));
  return services.feed.listen(request.caller, since);
}

}  // namespace

std::vector<Route> server_routes() {
  return {{"GET", "/healthz", for_anybody, not_audited, get_health, {}, net::Urgency::health},
          {"GET", "/readyz", for_anybody, not_audited, get_readiness, {}, net::Urgency::health},
          {"GET", "/metrics", for_monitoring, not_audited, get_gauges, {}, net::Urgency::health},
          {"GET", "/api/v1/openapi.yaml", for_anybody, not_audited, get_contract},
          {"GET", "/api/v1/events", access::all_roles, not_audited, listen_to_changes}};
}

}  // namespace ream::api
