#pragma once
#include <filesystem>

#include "access/access_control.hpp"
#include "api/session_service.hpp"
#include "api/study_service.hpp"

namespace ream::api {

/// What studies ask of this server; all that is given outlives them.
StudySurroundings study_surroundings(const std::filesystem::path& cases_folder, SessionService& sessions,
                                     access::AccessControl& gatehouse);

}  // namespace ream::api
