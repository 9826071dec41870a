#pragma once
#include "api/audit.hpp"
#include "api/study_service.hpp"
#include "net/router.hpp"

namespace ream::api {

/// /api/v1/studies and all below it. What changes who may know what, and every look at who is who, is told to
/// `audit`. `service` null: Error unavailable for everything.
void add_study_routes(net::Router& router, StudyService* service, const Audit& audit);

}  // namespace ream::api
