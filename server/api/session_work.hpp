#pragma once
#include <filesystem>
#include <functional>

#include "api/job_service.hpp"
#include "api/session_folder.hpp"
#include "core/file_lock.hpp"

namespace ream::api {

/// Keeps others from changing the files of a session that has ended. Error conflict while somebody does.
FileLock lock_of_ended(const std::filesystem::path& folder);

/// Has long work done in the folder of a session that has ended, whose files nobody else changes meanwhile;
/// of one kind once at a time, so that who asks again gets the same job. Errors: those of
/// JobService::submit().
JobRecord work_in_folder(JobService& jobs, const std::string& kind, const SessionRecord& record,
                         const std::filesystem::path& folder,
                         const std::function<void(const std::filesystem::path&, const Progress&)>& work);

}  // namespace ream::api
