#pragma once
#include <nlohmann/json_fwd.hpp>

#include "api/session_folder.hpp"

namespace ream::api {

/// Session of openapi.yaml.
nlohmann::json to_json(const SessionRecord& record);

}  // namespace ream::api
