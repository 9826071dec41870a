#include "api/server.hpp"

#include <algorithm>
#include <contract.hpp>
#include <nlohmann/json.hpp>

#include "api/access_resource.hpp"
#include "api/annotation_resource.hpp"
#include "api/case_resource.hpp"
#include "api/case_work_resource.hpp"
#include "api/event_resource.hpp"
#include "api/job_resource.hpp"
#include "api/prometheus.hpp"
#include "api/replay_resource.hpp"
#include "api/session_download_resource.hpp"
#include "api/session_resource.hpp"
#include "api/session_trash_resource.hpp"
#include "api/study_dependencies.hpp"
#include "api/study_resource.hpp"
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

void add_metrics_route(net::Router& router, const session::SessionService& sessions) {
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

/// Nowhere where there is no data folder.
std::filesystem::path under(const std::filesystem::path& data_folder, const char* name) {
  return data_folder.empty() ? std::filesystem::path() : data_folder / name;
}

void add_all_access_routes(net::Router& router, const AccessTools& tools) {
  add_login_routes(router, tools);
  add_user_routes(router, tools);
  add_token_routes(router, tools);
  add_link_routes(router, tools);
  add_audit_routes(router, tools);
}

void add_all_case_routes(net::Router& router, const ServerOptions& options, workup::CaseService& case_service,
                         workup::UploadStore& uploads, jobs::LowPriorityExecutor& executor) {
  add_case_routes(router, options.cases_folder);
  add_case_work_routes(router, case_service, uploads);
  add_case_volume_routes(router, case_service, executor, under(options.data_folder, "passing"));
  add_case_plan_routes(router, case_service, options.data_folder);
  add_upload_routes(router, uploads);
}

void add_all_score_routes(net::Router& router, const ScoreTools& tools) {
  add_rubric_routes(router, tools);
  add_benchmark_routes(router, tools);
  add_score_routes(router, tools);
  add_rescoring_routes(router, tools);
  add_deviation_routes(router, tools);
  add_learning_routes(router, tools);
}

}  // namespace

std::optional<session::SessionRequest> Server::session_of(const std::string& id) const {
  try {
    return sessions_.get(replays_.has(id) ? replays_.get(id).request.replay_of : id).request;
  } catch (const Error& unknown) {
    if (unknown.kind() != ErrorKind::not_found) throw;
    return std::nullopt;
  }
}

/// What it works on is worth reading again when it is done.
void Server::tell(const jobs::JobRecord& job) {
  feed_->tell({"job", job.id, to_text(job.state), job.order.session});
  if (job.state != jobs::JobState::done) return;
  if (!job.order.case_id.empty()) feed_->tell({"case", job.order.case_id, "changed"});
}

RetentionTools Server::retention_tools() {
  return {sessions_,
          replays_,
          jobs_,
          *feed_,
          [this](const std::string& study_id) { return studies_ && studies_->is_closed(study_id); },
          [this](const std::string& action, const std::string& session_id, const std::string& detail) {
            if (gatehouse_) gatehouse_->audit.note({"", "retention", "", "", ""}, action, session_id, detail);
          }};
}

net::Router Server::routes_of(const ServerOptions& options) {
  net::Router router;
  router.pace_callers(options.listen.limits.requests_per_caller);
  middleware_.install(router);
  add_event_routes(router, feed_);
  add_health_routes(router, readiness_);
  add_metrics_route(router, sessions_);
  add_contract_route(router);
  add_all_access_routes(
      router, {authorizer_, gatehouse_.get(), [this](const std::string& id) { sessions_.get(id); }});
  add_all_case_routes(router, options, case_service_, uploads_, executor_);
  add_session_routes(router, sessions_, replays_, readiness_, options.default_device, studies_.get());
  add_trash_routes(router, {sessions_, replays_, studies_.get(), retention_, *feed_});
  add_annotation_routes(router, sessions_);
  add_download_routes(
      router, {sessions_, studies_.get(), jobs_, *engine_, executor_, under(options.data_folder, "passing")});
  add_job_routes(router, jobs_);
  add_replay_routes(router, sessions_, replays_, readiness_);
  add_study_routes(router, studies_.get(), audit_in(gatehouse_.get()));
  add_all_score_routes(router, {sessions_, replays_, studies_.get(), jobs_, executor_, *feed_, stores_,
                                *engine_, audit_in(gatehouse_.get())});
  router.otherwise([files = net::StaticFiles(options.web_folder)](const net::Request& request) {
    return files.respond(request);
  });
  router.guard(
      [this](net::Request& request, const std::string& pattern) { authorizer_.authorize(request, pattern); });
  if (stream_watch_)
    router.wrap_websockets(
        [this](const net::Request& request, std::unique_ptr<net::WebSocketSession> session) {
          return stream_watch_->watched(request, std::move(session));
        });
  return router;
}

Server::Server(ServerOptions options)
    : database_(options.database),
      feed_(std::make_shared<ChangeFeed>(may_know)),
      contract_(std::string(embedded::contract::find("openapi.yaml"))),
      idempotency_(options.database),
      engine_(std::move(options.engine)),
      stores_({score::RubricStore(under(options.data_folder, "rubrics")),
               score::BenchmarkStore(under(options.data_folder, "benchmarks")),
               !options.data_folder.empty()}),
      jobs_({under(options.data_folder, "jobs"), std::chrono::hours(24), 256,
             [this](const jobs::JobRecord& job) { tell(job); }}),
      gatehouse_(database_ ? std::make_unique<access::AccessControl>(*database_, options.gatehouse)
                           : nullptr),
      stream_watch_(gatehouse_ ? std::make_unique<StreamWatch>(gatehouse_->credentials) : nullptr),
      sessions_(*engine_, options.sessions, options.sessions_folder, options.database),
      studies_(database_ ? std::make_unique<study::StudyService>(
                               *database_, study_dependencies(options.cases_folder, sessions_, *gatehouse_))
                         : nullptr),
      replays_(*engine_, options.replays),
      retention_(options.retention, retention_tools()),
      uploads_(under(options.data_folder, "uploads")),
      case_service_(options.cases_folder, sessions_, jobs_),
      authorizer_(gatehouse_.get(), [this](const std::string& id) { return session_of(id); }),
      middleware_(
          contract_, idempotency_, *feed_, [this](const std::string& id) { return session_of(id); },
          audit_in(gatehouse_.get())),
      router_(routes_of(options)),
      listener_(router_, options.listen),
      readiness_(std::move(options.prepare)),
      watch_(sessions_, *feed_) {}

Server::~Server() { stop(); }

void Server::start() {
  listener_.start();
  retention_.begin();
}

void Server::stop() {
  listener_.stop();
  retention_.stop();
  watch_.stop();
  jobs_.shut_down();
  replays_.shut_down();
  sessions_.shut_down();
}

}  // namespace ream::api
