#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "sim/model.hpp"

namespace ream::sim {

/// Settings as recordings keep them: all that the same input needs to give the same bits, so not the backend.
/// Numbers keep every bit.
nlohmann::json to_json(const Settings& settings);

/// What to_json wrote; `backend` is left at "cpu". Error invalid_input naming `place` and the key for one
/// that is missing, unknown or of another type.
Settings settings_from_json(const nlohmann::json& json, const std::string& place);

}  // namespace ream::sim
