#pragma once
#include "api/readiness.hpp"
#include "api/session_service.hpp"
#include "net/router.hpp"

namespace ream::api {

/// /api/v1/sessions and all below it. `service` and `readiness` outlive the router.
void add_session_routes(net::Router& router, SessionService& service, const Readiness& readiness);

}  // namespace ream::api
