#pragma once
#include "api/change_feed.hpp"
#include "api/replay_service.hpp"
#include "api/retention.hpp"
#include "api/session_service.hpp"
#include "api/study_service.hpp"
#include "net/router.hpp"

namespace ream::api {

/// What deleting sessions takes. All outlive the router.
struct TrashTools {
  SessionService& sessions;
  ReplayService& replays;
  const StudyService* studies;  ///< null without a database
  Retention& retention;
  ChangeFeed& feed;
};

/// DELETE of a session, POST .../restore and /api/v1/trash.
void add_trash_routes(net::Router& router, const TrashTools& tools);

}  // namespace ream::api
