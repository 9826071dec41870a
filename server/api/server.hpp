#pragma once
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "access/access_control.hpp"
#include "api/authorizer.hpp"
#include "api/readiness.hpp"
#include "api/request_middleware.hpp"
#include "api/retention.hpp"
#include "api/score_tools.hpp"
#include "api/session_watch.hpp"
#include "api/stream_watch.hpp"
#include "jobs/job_service.hpp"
#include "jobs/low_priority_executor.hpp"
#include "net/listener.hpp"
#include "session/service/replay_service.hpp"
#include "session/service/session_service.hpp"
#include "study/study_service.hpp"
#include "workup/case_service.hpp"

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
  /// Has users and what they did, the index of sessions, and answers to repeat. Null: everybody may do
  /// everything, and lists come from the folders.
  std::shared_ptr<store::Database> database;
  access::AccessOptions gatehouse;
  std::function<void()> prepare;  ///< run once in the background; /readyz is 503 until it is done
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

  /// Users, credentials and the audit log; null without a database.
  access::AccessControl* gatehouse() const { return gatehouse_.get(); }

  /// Method and pattern of everything served, the page left out.
  std::vector<net::Router::Route> routes() const { return router_.routes(); }

 private:
  net::Router routes_of(const ServerOptions& options);
  void tell(const jobs::JobRecord& job);
  RetentionTools retention_tools();
  std::optional<session::SessionRequest> session_of(const std::string& id) const;

  // Order matters: nothing is prepared before the port is ours. stop() has ended the listener before any of
  // these goes.
  const std::shared_ptr<store::Database> database_;
  const std::shared_ptr<ChangeFeed> feed_;
  const Contract contract_;
  Idempotency idempotency_;
  const std::shared_ptr<session::SessionEngine> engine_;
  const ScoreStores stores_;
  jobs::JobService jobs_;
  jobs::LowPriorityExecutor executor_;
  const std::unique_ptr<access::AccessControl> gatehouse_;
  const std::unique_ptr<StreamWatch> stream_watch_;  ///< null without a database
  session::SessionService sessions_;
  const std::unique_ptr<study::StudyService> studies_;  ///< null without a database
  session::ReplayService replays_;
  Retention retention_;
  workup::UploadStore uploads_;
  workup::CaseService case_service_;
  const Authorizer authorizer_;
  RequestMiddleware middleware_;
  net::Router router_;
  net::Listener listener_;
  Readiness readiness_;
  SessionWatch watch_;
};

}  // namespace ream::api
