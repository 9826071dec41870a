#pragma once
#include <nlohmann/json_fwd.hpp>

#include "session/folder/session_folder.hpp"

namespace ream::api {

/// Session of openapi.yaml.
nlohmann::json to_json(const session::SessionRecord& record);

}  // namespace ream::api
