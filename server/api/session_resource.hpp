#pragma once
#include "api/readiness.hpp"
#include "api/replay_service.hpp"
#include "api/session_service.hpp"
#include "api/study_service.hpp"
#include "net/router.hpp"

namespace ream::api {

/// /api/v1/sessions and all below it; ids of replays are answered by `replays`. What is given outlives the
/// router. `usual_device`: of sessions that name none. `studies`: say who may be known by name; null: there
/// are none.
void add_session_routes(net::Router& router, SessionService& service, ReplayService& replays,
                        const Readiness& readiness, const std::string& usual_device,
                        const StudyService* studies);

}  // namespace ream::api
