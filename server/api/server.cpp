#include "api/server.hpp"

#include <algorithm>
#include <contract.hpp>
#include <nlohmann/json.hpp>

#include "api/annotation_resource.hpp"
#include "api/case_resource.hpp"
#include "api/case_work_resource.hpp"
#include "api/event_resource.hpp"
#include "api/job_resource.hpp"
#include "api/prometheus.hpp"
#include "api/replay_resource.hpp"
#include "api/session_resource.hpp"
#include "api/upload_resource.hpp"
#include "core/error.hpp"
#include "net/static_files.hpp"

namespace ream::api {
namespace {

void add_health_routes(net::Router& router, const Readiness& readiness) {
  router.on("GET", "/healthz", [](const net::Request&) {
    return net::json_response(200, {{"status", "ok"}});
  });
  router.on("GET", "/readyz", [&readiness](const net::Request&) {
    readiness.require_ready();
    return net::json_response(200, {{"status", "ready"}});
  });
}

void add_metrics_route(net::Router& router, const SessionService& sessions) {
  router.on("GET", "/metrics", [&sessions](const net::Request&) {
    return net::bytes_response(200, "text/plain; version=0.0.4; charset=utf-8",
                               net::share(prometheus_text(sessions.held())));
  });
}

void add_contract_route(net::Router& router) {
  router.on("GET", "/api/v1/openapi.yaml", [](const net::Request&) {
    return net::bytes_response(200, "application/yaml", net::share(embedded::contract::find("openapi.yaml")));
  });
}

CaseTools tools_of(const ServerOptions& options, const SessionService& sessions) {
  return {options.read_ct, [&sessions](const std::string& case_id) {
            const auto all = sessions.list();
            return static_cast<size_t>(std::count_if(
                all.begin(), all.end(),
                [&](const SessionRecord& record) { return record.request.case_id == case_id; }));
          }};
}

void add_all_case_routes(net::Router& router, const ServerOptions& options, CaseWorkshop& workshop,
                         UploadStore& uploads) {
  add_case_routes(router, options.cases_folder);
  add_case_work_routes(router, workshop, uploads);
  add_case_volume_routes(router, workshop);
  add_case_plan_routes(router, workshop, options.data_folder);
  add_upload_routes(router, uploads);
  add_job_routes(router, workshop.jobs());
}

/// Of a session, or of the one that a replay shows.
std::optional<SessionRequest> session_of(const SessionService& sessions, const ReplayService& replays,
                                         const std::string& id) {
  try {
    return sessions.get(replays.has(id) ? replays.get(id).request.replay_of : id).request;
  } catch (const Error&) {
    return std::nullopt;
  }
}

net::Router router_of(const ServerOptions& options, SessionService& sessions, ReplayService& replays,
                      CaseWorkshop& workshop, UploadStore& uploads, const Readiness& readiness,
                      RequestFrame& frame, const std::shared_ptr<ChangeFeed>& feed) {
  net::Router router;
  frame.put_around(router);
  add_event_routes(router, feed);
  add_health_routes(router, readiness);
  add_metrics_route(router, sessions);
  add_contract_route(router);
  add_all_case_routes(router, options, workshop, uploads);
  add_session_routes(router, sessions, replays, readiness, options.usual_device);
  add_annotation_routes(router, sessions);
  add_replay_routes(router, sessions, replays, readiness);
  router.otherwise([files = net::StaticFiles(options.web_folder)](const net::Request& request) {
    return files.respond(request);
  });
  return router;
}

}  // namespace

Server::Server(ServerOptions options)
    : feed_(std::make_shared<ChangeFeed>(may_know)),
      contract_(std::string(embedded::contract::find("openapi.yaml"))),
      idempotency_(options.database),
      sessions_(std::move(options.make_session), options.sessions, options.sessions_folder),
      replays_(std::move(options.make_replay), options.replays),
      uploads_(options.data_folder.empty() ? std::filesystem::path() : options.data_folder / "uploads"),
      workshop_(options.cases_folder, tools_of(options, sessions_)),
      frame_(contract_, idempotency_, *feed_,
             [this](const std::string& id) { return session_of(sessions_, replays_, id); }),
      router_(router_of(options, sessions_, replays_, workshop_, uploads_, readiness_, frame_, feed_)),
      listener_(router_, options.listen),
      readiness_(std::move(options.prepare)),
      watch_(sessions_, *feed_) {}

Server::~Server() { stop(); }

void Server::start() { listener_.start(); }

void Server::run() {
  start();
  {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return stop_wanted_; });
  }
  stop();
}

void Server::request_stop() {
  {
    const std::lock_guard lock(mutex_);
    stop_wanted_ = true;
  }
  changed_.notify_all();
}

void Server::stop() {
  listener_.stop();
  watch_.stop();
  workshop_.jobs().shut_down();
  replays_.shut_down();
  sessions_.shut_down();
}

}  // namespace ream::api
