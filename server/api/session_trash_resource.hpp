#pragma once
#include "api/change_feed.hpp"
#include "api/retention.hpp"
#include "net/router.hpp"
#include "session/service/replay_service.hpp"
#include "session/service/session_service.hpp"
#include "study/study_service.hpp"

namespace ream::api {

/// What deleting sessions takes. All outlive the router.
struct TrashTools {
  session::SessionService& sessions;
  session::ReplayService& replays;
  const study::StudyService* studies;  ///< null without a database
  Retention& retention;
  ChangeFeed& feed;
};

/// DELETE of a session, POST .../restore and /api/v1/trash.
void add_trash_routes(net::Router& router, const TrashTools& tools);

}  // namespace ream::api
