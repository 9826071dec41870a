#pragma once
#include "net/router.hpp"
#include "session/service/session_service.hpp"

namespace ream::api {

/// /api/v1/sessions/{id}/annotations. `service` outlives the router.
void add_annotation_routes(net::Router& router, session::SessionService& service);

}  // namespace ream::api
