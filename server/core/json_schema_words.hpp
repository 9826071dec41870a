#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace ream {

/// The schema that a place inside a value must fit: follows references, properties, items and alternatives of
/// `document`. `place`: keys and indices from the whole value on. Null when the schema says nothing of it.
const nlohmann::json* schema_at(const nlohmann::json& document, const nlohmann::json& schema,
                                const std::vector<std::string>& place);

/// What a schema asks of a value, for people: "must be a number above 0 and at most 1000".
std::string rule_words(const nlohmann::json& document, const nlohmann::json& schema);

}  // namespace ream
