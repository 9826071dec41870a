#pragma once
#include "api/change_feed.hpp"
#include "net/router.hpp"

namespace ream::api {

/// WebSocket /api/v1/events. The feed is kept by who listens.
void add_event_routes(net::Router& router, const std::shared_ptr<ChangeFeed>& feed);

}  // namespace ream::api
