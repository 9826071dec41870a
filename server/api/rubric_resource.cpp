#include <algorithm>
#include <nlohmann/json.hpp>

#include "api/replies.hpp"
#include "api/request_values.hpp"
#include "api/routes.hpp"
#include "api/services.hpp"
#include "core/error.hpp"
#include "core/json.hpp"
#include "net/conditional.hpp"

namespace ream::api {
using nlohmann::json;
namespace {

const std::string rubrics_path = "/api/v1/rubrics";

bool has_rubric(const score::RubricStore& store, const std::string& id) {
  const auto ids = store.ids();
  return std::find(ids.begin(), ids.end(), id) != ids.end();
}

void require_rubric(const score::RubricStore& store, const std::string& id) {
  if (!has_rubric(store, id)) throw Error(ErrorKind::not_found, "no rubric '" + id + "'");
}

void require_place(const ScoreStores& stores) {
  if (!stores.writable) throw Error(ErrorKind::unavailable, "this server keeps no rubrics");
}

json kept_rubric(const score::RubricStore& store, const std::string& id, const score::Rubric& rubric) {
  return {{"id", id},
          {"version", rubric.version},
          {"versions", store.versions(id)},
          {"rubric", score::rubric_json(rubric)}};
}

/// What a rubric may ask for.
net::Response list_metrics(const Services&, const net::Request&) {
  json metrics = json::array();
  for (const score::Metric& metric : score::metric_catalogue())
    metrics.push_back({{"metric", metric.key},
                       {"name", metric.name},
                       {"unit", or_null(metric.unit)},
                       {"definition", metric.definition},
                       {"source", metric.source},
                       {"band", score::band_json(metric.band)}});
  return net::json_response(200, {{"metrics", std::move(metrics)}});
}

net::Response list_rubrics(const Services& services, const net::Request&) {
  const score::RubricStore& store = services.stores.rubrics;
  json rubrics = json::array();
  for (const std::string& id : store.ids()) {
    const score::Rubric newest = store.get(id);
    rubrics.push_back({{"id", id},
                       {"name", newest.name},
                       {"version", newest.version},
                       {"versions", store.versions(id)},
                       {"remark", newest.remark},
                       {"pass_points", newest.pass_points ? json(*newest.pass_points) : json(nullptr)}});
  }
  return net::json_response(200, {{"rubrics", std::move(rubrics)}});
}

net::Response get_rubric(const Services& services, const net::Request& request) {
  const score::RubricStore& store = services.stores.rubrics;
  const std::string& id = id_of(request);
  require_rubric(store, id);
  const int version = static_cast<int>(query_number(request, "version", 0.0));
  return net::json_response(200,
                            kept_rubric(store, id, version == 0 ? store.get(id) : store.get(id, version)));
}

net::Response create_rubric(const Services& services, const net::Request& request) {
  const ScoreStores& stores = services.stores;
  const std::string id = body_of(request).at("id");
  score::Rubric rubric = requested_rubric(body_of(request).at("rubric"));
  const std::lock_guard one_at_a_time(stores.editing);
  if (has_rubric(stores.rubrics, id))
    throw Error(ErrorKind::conflict, "there is a rubric '" + id + "' already; PUT edits it");
  require_place(stores);
  const score::Rubric kept = stores.rubrics.save(id, std::move(rubric));
  services.audit(request, "rubric.create", id, kept.name);
  return created(rubrics_path + "/" + id, kept_rubric(stores.rubrics, id, kept));
}

/// Two who edit the same version: the second is told so.
net::Response edit_rubric(const Services& services, const net::Request& request) {
  const ScoreStores& stores = services.stores;
  const std::string& id = id_of(request);
  score::Rubric rubric = requested_rubric(body_of(request));
  const std::lock_guard one_at_a_time(stores.editing);
  require_rubric(stores.rubrics, id);
  const json now = kept_rubric(stores.rubrics, id, stores.rubrics.get(id));
  net::require_match(request, net::entity_tag(*net::json_response(200, now).body));
  const int newest = stores.rubrics.versions(id).back();
  if (rubric.version != newest)
    throw Error(ErrorKind::conflict, "rubric '" + id + "' is at version " + std::to_string(newest) +
                                         ", and the body says it edits version " +
                                         std::to_string(rubric.version) +
                                         "; read the newest and repeat the change there");
  require_place(stores);
  const score::Rubric kept = stores.rubrics.save(id, std::move(rubric));
  services.audit(request, "rubric.edit", id, "version " + std::to_string(kept.version));
  return net::json_response(200, kept_rubric(stores.rubrics, id, kept));
}

}  // namespace

std::vector<Route> rubric_routes() {
  return {{"GET", "/api/v1/metrics", access::reamers, not_audited, list_metrics},
          {"GET", rubrics_path, access::reamers, not_audited, list_rubrics},
          {"POST", rubrics_path, access::staff, audited_by_handler, create_rubric},
          {"GET", rubrics_path + "/{id}", access::reamers, not_audited, get_rubric},
          {"PUT", rubrics_path + "/{id}", access::staff, audited_by_handler, edit_rubric}};
}

}  // namespace ream::api
