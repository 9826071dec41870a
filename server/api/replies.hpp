#pragma once
#include <nlohmann/json_fwd.hpp>

#include "access/users.hpp"
#include "jobs/job_service.hpp"
#include "session/folder/session_folder.hpp"
#include "session/scoring/export_table.hpp"
#include "session/service/replay_service.hpp"
#include "study/study.hpp"

namespace ream::api {

// What several handlers answer, as openapi.yaml has it.

nlohmann::json to_json(const session::SessionRecord& record);
nlohmann::json to_json(const session::ReplayRecord& record);
nlohmann::json to_json(const study::Participant& participant);
nlohmann::json user_json(const access::User& user);

/// 201 with the new thing and where it is.
net::Response created(const std::string& where, const nlohmann::json& body);
/// 202 with the job and where to ask about it.
net::Response accepted(const net::Caller& caller, const jobs::JobRecord& job);
/// A table to be saved under the file's name.
net::Response csv_response(const session::ExportTable& table, const std::string& file);
/// 204.
net::Response no_content();

}  // namespace ream::api
