#pragma once
#include "api/session_service.hpp"
#include "net/router.hpp"

namespace ream::api {

/// /api/v1/sessions/{id}/annotations. `service` outlives the router.
void add_annotation_routes(net::Router& router, SessionService& service);

}  // namespace ream::api
