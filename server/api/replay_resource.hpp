#pragma once
#include "api/readiness.hpp"
#include "net/router.hpp"
#include "session/service/replay_service.hpp"
#include "session/service/session_service.hpp"

namespace ream::api {

/// POST /api/v1/sessions/{id}/replay and /playback. All else that a replay is asked goes to the paths of
/// sessions. What is given outlives the router.
void add_replay_routes(net::Router& router, const session::SessionService& sessions,
                       session::ReplayService& replays, const Readiness& readiness);

/// Replay of openapi.yaml.
nlohmann::json to_json(const session::ReplayRecord& record);

}  // namespace ream::api
