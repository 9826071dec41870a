#pragma once
#include <filesystem>
#include <functional>

#include "core/file_lock.hpp"
#include "jobs/job_service.hpp"
#include "net/message.hpp"
#include "session/folder/session_folder.hpp"

namespace ream::api {

/// Error conflict for one that has not ended; `what` can be done then, for people.
void require_ended(const session::SessionRecord& record, const std::string& what);

/// Keeps others from changing the files of a session that has ended. Error conflict while somebody does.
FileLock lock_of_ended(const std::filesystem::path& folder);

/// Has long work done in the folder of a session that has ended, whose files nobody else changes meanwhile;
/// of one kind once at a time, so that who asks again gets the same job. Errors: those of
/// JobService::submit().
jobs::JobRecord work_in_folder(
    jobs::JobService& jobs, const std::string& kind, const net::Caller& caller,
    const session::SessionRecord& record, const std::filesystem::path& folder,
    const std::function<void(const std::filesystem::path&, const Progress&)>& work);

}  // namespace ream::api
