#pragma once
#include <filesystem>

#include "jobs/job_service.hpp"
#include "jobs/low_priority_executor.hpp"
#include "net/router.hpp"
#include "session/service/session_service.hpp"
#include "study/study_service.hpp"

namespace ream::api {

/// What the downloads of sessions are made of; all of it outlives the router.
struct DownloadTools {
  session::SessionService& sessions;
  const study::StudyService* studies;  ///< null: there are none
  jobs::JobService& jobs;
  session::SessionEngine& engine;
  jobs::LowPriorityExecutor& executor;
  std::filesystem::path temporary_folder;  ///< for files that are made to be sent once
};

/// GET /api/v1/sessions/{id}/recording, session.json, trace, mesh and snapshot, and POST exports.
void add_download_routes(net::Router& router, const DownloadTools& tools);

}  // namespace ream::api
