#pragma once
#include <nlohmann/json_fwd.hpp>

#include "jobs/job_service.hpp"
#include "net/router.hpp"

namespace ream::api {

/// /api/v1/jobs. The service must outlive the router.
void add_job_routes(net::Router& router, jobs::JobService& jobs);

/// 202 with the job and where to ask about it.
net::Response accepted(const jobs::JobRecord& job);

/// Whether a caller may know of the work: operators and instructors of all, others of that on sessions that
/// they may see.
bool may_see(const net::Caller& caller, const jobs::JobRecord& job);

}  // namespace ream::api
