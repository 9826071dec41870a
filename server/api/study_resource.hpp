#pragma once
#include "api/audit.hpp"
#include "net/router.hpp"
#include "study/study_service.hpp"

namespace ream::api {

/// /api/v1/studies and all below it. What changes who may know what, and every look at who is who, is told to
/// `audit`. `service` null: Error unavailable for everything.
void add_study_routes(net::Router& router, study::StudyService* service, const Audit& audit);

}  // namespace ream::api
