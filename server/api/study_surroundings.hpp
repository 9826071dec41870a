#pragma once
#include <filesystem>

#include "access/gatehouse.hpp"
#include "api/session_service.hpp"
#include "api/study_service.hpp"

namespace ream::api {

/// What studies ask of this server; all that is given outlives them.
StudySurroundings study_surroundings(const std::filesystem::path& cases_folder, SessionService& sessions,
                                     access::Gatehouse& gatehouse);

}  // namespace ream::api
