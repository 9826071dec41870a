#include "api/server.hpp"
#include "core/log.hpp"
#include "core/process_memory.hpp"
#include "core/temporary_file.hpp"

#include <contract.hpp>

#include "api/study_dependencies.hpp"
#include "net/static_files.hpp"

namespace ream::api {
namespace {

/// Nowhere where there is no data folder.
std::filesystem::path under(const std::filesystem::path& data_folder, const char* name) {
  return data_folder.empty() ? std::filesystem::path() : data_folder / name;
}

}  // namespace

/// What it works on is worth reading again when it is done.
void Server::publish(const jobs::JobRecord& job) {
  feed_->publish({"job", job.id, to_text(job.state), job.order.session});
  if (job.state != jobs::JobState::done) return;
  if (!job.order.case_id.empty()) feed_->publish({"case", job.order.case_id, "changed"});
}

net::Router Server::router_for(const ServerOptions& options) const {
  net::Router router;
  router.pace_callers(options.listen.limits.requests_per_caller);
  middleware_.install(router);
  router.otherwise([files = net::StaticFiles(options.web_folder)](const net::Request& request) {
    return files.respond(request);
  });
  return router;
}

Server::Server(ServerOptions options)
    : database_(options.database),
      contract_(std::string(embedded::contract::find("openapi.yaml"))),
      idempotency_(*database_),
      engine_(std::move(options.engine)),
      stores_{score::RubricStore(under(options.data_folder, "rubrics")),
              score::BenchmarkStore(under(options.data_folder, "benchmarks")), !options.data_folder.empty()},
      jobs_({under(options.data_folder, "jobs"), std::chrono::hours(24), 256,
             [this](const jobs::JobRecord& job) { publish(job); }}),
      access_control_(*database_, options.access),
      stream_watch_(access_control_),
      sessions_(*engine_, options.sessions, options.sessions_folder, *database_),
      study_dependencies_(study_dependencies(options.cases_folder, sessions_, access_control_)),
      studies_(*database_, study_dependencies_),
      ratings_(*database_, studies_, study_dependencies_),
      feel_(*database_, studies_, study_dependencies_),
      replays_(*engine_, options.replays),
      served_(sessions_, replays_, ratings_, feel_),
      retention_(options.retention,
                 {sessions_, replays_, jobs_, idempotency_, *feed_, studies_, access_control_.audit}),
      uploads_(under(options.data_folder, "uploads")),
      case_service_(options.cases_folder, sessions_, jobs_),
      authorizer_(access_control_, served_),
      services_{access_control_,
                authorizer_,
                sessions_,
                replays_,
                *engine_,
                studies_,
                ratings_,
                feel_,
                jobs_,
                executor_,
                case_service_,
                uploads_,
                stores_,
                *feed_,
                retention_,
                readiness_,
                database_watch_,
                options.cases_folder,
                options.data_folder,
                under(options.data_folder, "passing"),
                options.default_device},
      middleware_(services_, served_, contract_, idempotency_, stream_watch_),
      router_(router_for(options)),
      listener_(router_, options.listen),
      readiness_(*engine_, options.make_demo_case),
      database_watch_(database_),
      watch_(sessions_, *feed_),
      unused_(
          "sessions that nobody starts or that stay paused, and uploads that nobody goes on with", [this] {
            if (keep_memory_reserve())
              log::warn("memory ran out, and what was kept back for that was used; give this machine more");
            sessions_.end_unused();
            uploads_.remove_idle();
            return std::chrono::seconds(5);
          }) {}

Server::~Server() { stop(); }

void Server::start() {
  // What an earlier server did not come to send.
  remove_tree(services_.temporary_folder);
  listener_.start();
  retention_.begin();
  unused_.start();
  database_watch_.start();
}

void Server::stop() {
  listener_.stop();
  retention_.stop();
  watch_.stop();
  database_watch_.stop();
  unused_.stop();
  jobs_.shut_down();
  replays_.shut_down();
  sessions_.shut_down();
}

}  // namespace ream::api
