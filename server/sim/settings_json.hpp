#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "sim/model.hpp"

namespace ream::sim {

/// Settings as recordings keep them: all that the same input needs to give the same bits, so not the backend.
/// Numbers keep every bit.
nlohmann::json to_json(const Settings& settings);

/// What to_json wrote; `backend` is left at "cpu". A key that is missing keeps its default, so that
/// recordings from before a setting existed can be read: the default of a new setting is what was done before
/// it. Error invalid_input naming `place` and the key for one that is unknown (of a newer build) or of
/// another type.
Settings settings_from_json(const nlohmann::json& json, const std::string& place);

}  // namespace ream::sim
