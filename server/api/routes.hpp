#pragma once
#include <vector>

#include "api/route.hpp"

namespace ream::api {

/// All routes of the server, one row each; the page's files are served beside them.
const std::vector<Route>& routes();

// The parts of the table, each beside its handlers.
std::vector<Route> server_routes();
std::vector<Route> login_routes();
std::vector<Route> user_routes();
std::vector<Route> token_routes();
std::vector<Route> link_routes();
std::vector<Route> audit_routes();
std::vector<Route> upload_routes();
std::vector<Route> job_routes();
std::vector<Route> case_routes();
std::vector<Route> case_volume_routes();
std::vector<Route> case_plan_routes();
std::vector<Route> session_routes();
std::vector<Route> session_trash_routes();
std::vector<Route> annotation_routes();
std::vector<Route> replay_routes();
std::vector<Route> download_routes();
std::vector<Route> deviation_routes();
std::vector<Route> score_routes();
std::vector<Route> rescoring_routes();
std::vector<Route> learning_routes();
std::vector<Route> rubric_routes();
std::vector<Route> benchmark_routes();
std::vector<Route> study_routes();
std::vector<Route> rating_routes();
std::vector<Route> feel_routes();
std::vector<Route> sample_size_routes();

}  // namespace ream::api
