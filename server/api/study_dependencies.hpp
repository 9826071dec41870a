#pragma once
#include <filesystem>
#include <memory>

#include "access/access_control.hpp"
#include "session/service/session_service.hpp"
#include "study/study_service.hpp"

namespace ream::api {

/// What studies ask of this server; all that is given outlives them.
std::shared_ptr<const study::StudyDependencies> study_dependencies(const std::filesystem::path& cases_folder,
                                                                   session::SessionService& sessions,
                                                                   access::AccessControl& access_control);

}  // namespace ream::api
