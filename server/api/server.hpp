#pragma once
#include <filesystem>
#include <memory>
#include <string>

#include "api/request_middleware.hpp"
#include "api/services.hpp"
#include "api/session_watch.hpp"
#include "core/periodic_task.hpp"
#include "net/listener.hpp"

namespace ream::api {

struct ServerOptions {
  net::ListenOptions listen;
  std::filesystem::path cases_folder;
  std::filesystem::path data_folder;               ///< uploads, and users' reamers
  std::filesystem::path web_folder;                ///< the built page; served under "/"
  std::filesystem::path sessions_folder;           ///< where sessions keep their folders
  std::shared_ptr<session::SessionEngine> engine;  ///< what makes sessions, replays, scores and exports
  session::SessionLimits sessions;
  std::string default_device = "script";  ///< of sessions that name none
  session::ReplayLimits replays;
  RetentionRules retention;
  /// Has users and what they did, the index of sessions, studies, and answers to repeat. Never null. While it
  /// has no users, everybody may do everything.
  std::shared_ptr<store::Database> database;
  access::AccessOptions access;
  bool make_demo_case = false;  ///< in the background; /readyz is 503 until it is there
};

/// The whole server: REST resources, streams and page over one listener.
class Server {
 public:
  /// Binds the port (Error usage or unavailable, see net::Listener) and begins to prepare.
  explicit Server(ServerOptions options);
  /// Stops.
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  uint16_t port() const { return listener_.port(); }

  /// Begins to answer and returns.
  void start();
  /// Ends connections, then sessions. May be called twice.
  void stop();

  /// Users, credentials and the audit log.
  access::AccessControl& access_control() { return access_control_; }

 private:
  net::Router router_for(const ServerOptions& options) const;
  void publish(const jobs::JobRecord& job);

  // Order matters: nothing is prepared before the port is ours. stop() has ended the listener before any of
  // these goes.
  const std::shared_ptr<store::Database> database_;
  const std::shared_ptr<ChangeFeed> feed_ = std::make_shared<ChangeFeed>();
  const Contract contract_;
  Idempotency idempotency_;
  const std::shared_ptr<session::SessionEngine> engine_;
  const ScoreStores stores_;
  jobs::JobService jobs_;
  jobs::LowPriorityExecutor executor_;
  access::AccessControl access_control_;
  StreamWatch stream_watch_;
  session::SessionService sessions_;
  const std::shared_ptr<const study::StudyDependencies> study_dependencies_;
  study::StudyService studies_;
  study::RatingService ratings_;
  study::FeelService feel_;
  session::ReplayService replays_;
  const ServedSessions served_;
  Retention retention_;
  workup::UploadStore uploads_;
  workup::CaseService case_service_;
  const Authorizer authorizer_;
  const Services services_;
  const RequestMiddleware middleware_;
  net::Router router_;
  net::Listener listener_;
  Readiness readiness_;
  DatabaseWatch database_watch_;
  SessionWatch watch_;
  PeriodicTask unused_;  ///< ends sessions that nobody starts, removes uploads that nobody uses
};

}  // namespace ream::api
