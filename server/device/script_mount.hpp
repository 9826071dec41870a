#pragma once
#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "device/scapula_mount.hpp"

namespace ream {
class JsonReader;
}

namespace ream::device {

/// The script's key "mount", whose value is `mount`: "rigid" (empty), "chest_wall", or an object with all its
/// numbers. Errors: invalid_input naming place and key.
std::optional<ScapulaMount> parse_mount(const nlohmann::json& mount, JsonReader& script);

}  // namespace ream::device
