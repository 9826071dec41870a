#pragma once
#include <nlohmann/json_fwd.hpp>

#include "case/case.hpp"
#include "core/json_reader.hpp"

namespace ream::case_ {

/// centre_mm, lateral, superior and anterior, as in case.json. Error invalid_input names place and key unless
/// the directions are unit vectors.
GlenoidFrame glenoid_from_json(JsonReader reader);
nlohmann::json to_json(const GlenoidFrame& frame);

}  // namespace ream::case_
