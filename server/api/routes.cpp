#include "api/routes.hpp"

namespace ream::api {

const std::vector<Route>& routes() {
  static const std::vector<Route> all = [] {
    std::vector<Route> rows;
    for (const auto part :
         {server_routes,     login_routes,     user_routes,          token_routes,      link_routes,
          audit_routes,      upload_routes,    job_routes,           case_routes,       case_volume_routes,
          case_plan_routes,  session_routes,   session_trash_routes, annotation_routes, replay_routes,
          download_routes,   deviation_routes, score_routes,         rescoring_routes,  learning_routes,
          rubric_routes,     benchmark_routes, study_routes,         rating_routes,     feel_routes,
          sample_size_routes}) {
      auto more = part();
      rows.insert(rows.end(), more.begin(), more.end());
    }
    return rows;
  }();
  return all;
}

}  // namespace ream::api
