#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace ream::api {

/// A YAML text as JSON (core types of YAML 1.2; quoted scalars are text). Throws Error invalid_input.
nlohmann::json json_from_yaml(const std::string& text);

}  // namespace ream::api
