#pragma once
#include <filesystem>
#include <string>

#include "access/access_control.hpp"
#include "api/authorizer.hpp"
#include "api/change_feed.hpp"
#include "api/database_watch.hpp"
#include "api/readiness.hpp"
#include "api/retention.hpp"
#include "api/score_stores.hpp"
#include "jobs/job_service.hpp"
#include "jobs/low_priority_executor.hpp"
#include "session/service/replay_service.hpp"
#include "session/service/session_service.hpp"
#include "study/feel_service.hpp"
#include "study/rating_service.hpp"
#include "study/study_service.hpp"
#include "workup/case_service.hpp"

namespace ream::api {

/// What the handlers of one server work with. All of it outlives the router.
struct Services {
  access::AccessControl& access_control;
  const Authorizer& authorizer;
  session::SessionService& sessions;
  session::ReplayService& replays;
  session::SessionEngine& engine;
  study::StudyService& studies;
  study::RatingService& ratings;
  study::FeelService& feel;
  jobs::JobService& jobs;
  jobs::LowPriorityExecutor& executor;
  workup::CaseService& cases;
  workup::UploadStore& uploads;
  const ScoreStores& stores;
  ChangeFeed& feed;
  Retention& retention;
  const Readiness& readiness;
  const DatabaseWatch& database_watch;
  std::filesystem::path cases_folder;
  std::filesystem::path data_folder;       ///< has users' reamers
  std::filesystem::path temporary_folder;  ///< for files that are made to be sent once
  std::string default_device;              ///< of sessions that name none

  /// Keeps who has changed access or data: one row a change, after it has happened. `action` is a word such
  /// as "session.delete", `object` the id of what was changed, `detail` a few words for people, never a
  /// secret. Error unavailable when it cannot be kept.
  void audit(const net::Request& request, const std::string& action, const std::string& object,
             const std::string& detail) const;
  /// Keeps who reads data, once for each login.
  void audit_reading(const net::Request& request, const std::string& action, const std::string& object) const;

  /// One session as the caller may know it.
  session::SessionRecord seen(const net::Caller& caller, session::SessionRecord record) const;
};

}  // namespace ream::api
