#pragma once
#include <filesystem>

#include "net/router.hpp"

namespace ream::api {

/// GET /api/v1/cases and /api/v1/cases/{id}, read from the folder of cases at every request. A case that
/// cannot be read is left out of the list (the log says why) and explained when asked for by its id.
void add_case_routes(net::Router& router, const std::filesystem::path& cases_folder);

}  // namespace ream::api
