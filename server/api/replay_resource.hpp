#pragma once
#include "api/readiness.hpp"
#include "api/replay_service.hpp"
#include "api/session_service.hpp"
#include "net/router.hpp"

namespace ream::api {

/// POST /api/v1/sessions/{id}/replay and /playback. All else that a replay is asked goes to the paths of
/// sessions. What is given outlives the router.
void add_replay_routes(net::Router& router, const SessionService& sessions, ReplayService& replays,
                       const Readiness& readiness);

/// Replay of openapi.yaml.
nlohmann::json to_json(const ReplayRecord& record);

}  // namespace ream::api
