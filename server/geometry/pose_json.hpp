#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/json_reader.hpp"
#include "geometry/pose.hpp"

namespace ream {

/// [x, y, z].
nlohmann::json json_of(const Vec3& v);
/// Back again from three finite numbers. Errors: those of JsonReader::numbers.
Vec3 read_vec3(JsonReader& reader, const std::string& key);

/// {"rotation": three rows, "translation_mm": [x, y, z]}, to the bit.
nlohmann::json to_json(const Pose& pose);

/// Back again. Error invalid_input naming place and key unless the rotation is orthonormal and right-handed
/// to 1e-6 and everything is finite.
Pose pose_from_json(JsonReader reader);

}  // namespace ream
