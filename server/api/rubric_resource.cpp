#include <algorithm>
#include <mutex>
#include <nlohmann/json.hpp>

#include "api/request_body.hpp"
#include "api/score_tools.hpp"
#include "core/error.hpp"
#include "net/conditional.hpp"

namespace ream::api {
using nlohmann::json;
namespace {

const std::string rubrics_path = "/api/v1/rubrics";
const std::string body_place = "the request body";

/// Rubrics as requests read and edit them.
class Desk {
 public:
  explicit Desk(const ScoreTools& tools) : tools_(tools) {}

  net::Response list() const {
    json rubrics = json::array();
    for (const std::string& id : store().ids()) {
      const score::Rubric newest = store().get(id);
      rubrics.push_back({{"id", id},
                         {"name", newest.name},
                         {"version", newest.version},
                         {"versions", store().versions(id)},
                         {"remark", newest.remark},
                         {"pass_points", newest.pass_points ? json(*newest.pass_points) : json(nullptr)}});
    }
    return net::json_response(200, {{"rubrics", std::move(rubrics)}});
  }

  /// `version` 0: the newest.
  net::Response one(const std::string& id, int version) const {
    require(id);
    return net::json_response(200, told(id, version == 0 ? store().get(id) : store().get(id, version)));
  }

  net::Response create(const net::Request& request) {
    RequestBody body(request);
    const std::string id = body.name("id");
    const std::optional<json> wanted = body.value_or_none("rubric");
    body.finish();
    score::Rubric rubric = rubric_from(wanted.value_or(json()));
    const std::lock_guard one_at_a_time(editing_);
    if (has(id)) throw Error(ErrorKind::conflict, "there is a rubric '" + id + "' already; PUT edits it");
    require_place();
    const score::Rubric kept = store().save(id, std::move(rubric));
    tools_.audit(request, "rubric.create", id, kept.name);
    net::Response response = net::json_response(201, told(id, kept));
    response.headers.emplace_back("Location", rubrics_path + "/" + id);
    return response;
  }

  /// Two who edit the same version: the second is told so.
  net::Response edit(const net::Request& request) {
    const std::string& id = id_of(request);
    score::Rubric rubric = rubric_from(json_object_in(request));
    const std::lock_guard one_at_a_time(editing_);
    require(id);
    const net::Response now = one(id, 0);
    net::require_match(request, net::entity_tag(*now.body));
    const int newest = store().versions(id).back();
    if (rubric.version != newest)
      throw Error(ErrorKind::conflict, "rubric '" + id + "' is at version " + std::to_string(newest) +
                                           ", and the body says it edits version " +
                                           std::to_string(rubric.version) +
                                           "; read the newest and repeat the change there");
    require_place();
    const score::Rubric kept = store().save(id, std::move(rubric));
    tools_.audit(request, "rubric.edit", id, "version " + std::to_string(kept.version));
    return net::json_response(200, told(id, kept));
  }

 private:
  const score::RubricStore& store() const { return tools_.stores.rubrics; }

  bool has(const std::string& id) const {
    const auto ids = store().ids();
    return std::find(ids.begin(), ids.end(), id) != ids.end();
  }
  void require(const std::string& id) const {
    if (!has(id))
      throw Error(ErrorKind::not_found, "no rubric '" + id + "'; GET " + rubrics_path + " lists them");
  }
  void require_place() const {
    if (!tools_.stores.writable) throw Error(ErrorKind::unavailable, "this server keeps no rubrics");
  }
  /// Over the network a rubric asks only for what every session can say.
  static score::Rubric rubric_from(const json& value) {
    score::Rubric rubric = score::rubric_from_json(value, body_place);
    for (size_t i = 0; i < rubric.criteria.size(); ++i)
      if (const std::string& metric = rubric.criteria[i].metric; !score::find_metric(metric))
        throw net::RequestError(422, "there is no metric '" + metric + "'; a session's score names them",
                                {{"#/criteria/" + std::to_string(i) + "/metric", "is no metric"}});
    return rubric;
  }
  json told(const std::string& id, const score::Rubric& rubric) const {
    return {{"id", id},
            {"version", rubric.version},
            {"versions", store().versions(id)},
            {"rubric", score::rubric_json(rubric)}};
  }

  const ScoreTools tools_;
  std::mutex editing_;
};

int version_in(const net::Request& request) {
  const auto given = request.query.find("version");
  return given == request.query.end() ? 0 : json::parse(given->second).get<int>();
}

}  // namespace

void add_rubric_routes(net::Router& router, const ScoreTools& tools) {
  const auto desk = std::make_shared<Desk>(tools);
  router.on("GET", rubrics_path, [desk](const net::Request&) { return desk->list(); });
  router.on("POST", rubrics_path, [desk](const net::Request& request) { return desk->create(request); });
  router.on("GET", rubrics_path + "/{id}",
            [desk](const net::Request& request) { return desk->one(id_of(request), version_in(request)); });
  router.on("PUT", rubrics_path + "/{id}",
            [desk](const net::Request& request) { return desk->edit(request); });
}

}  // namespace ream::api
