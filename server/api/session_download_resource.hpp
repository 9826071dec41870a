#pragma once
#include <filesystem>

#include "api/export_formats.hpp"
#include "api/job_service.hpp"
#include "api/quiet_work.hpp"
#include "api/session_service.hpp"
#include "api/study_service.hpp"
#include "net/router.hpp"

namespace ream::api {

/// What the downloads of sessions are made of; all of it outlives the router.
struct DownloadTools {
  SessionService& sessions;
  const StudyService* studies;  ///< null: there are none
  JobService& jobs;
  const ExportFormats& formats;
  QuietWork& quiet;
  std::filesystem::path temporary_folder;  ///< for files that are made to be sent once
};

/// GET /api/v1/sessions/{id}/recording, session.json, trace, mesh and snapshot, and POST exports.
void add_download_routes(net::Router& router, const DownloadTools& tools);

}  // namespace ream::api
