#pragma once
#include "api/readiness.hpp"
#include "net/router.hpp"
#include "session/service/replay_service.hpp"
#include "session/service/session_service.hpp"
#include "study/study_service.hpp"

namespace ream::api {

/// /api/v1/sessions and all below it; ids of replays are answered by `replays`. What is given outlives the
/// router. `default_device`: of sessions that name none. `studies`: say who may be known by name; null: there
/// are none.
void add_session_routes(net::Router& router, session::SessionService& service,
                        session::ReplayService& replays, const Readiness& readiness,
                        const std::string& default_device, const study::StudyService* studies);

}  // namespace ream::api
