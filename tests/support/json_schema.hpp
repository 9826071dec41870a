#pragma once
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "core/json_schema.hpp"

namespace ream::test {

/// What is wrong with a value, a line each; empty when it fits. `schema` may refer to `document`.
inline std::vector<std::string> schema_faults(const nlohmann::json& schema, const nlohmann::json& value,
                                              const nlohmann::json& document) {
  std::vector<std::string> lines;
  for (const SchemaFault& fault : JsonSchema(schema, document).faults(value))
    lines.push_back(fault.pointer + ": " + fault.detail);
  return lines;
}
/// Of a schema that is a document of its own.
inline std::vector<std::string> schema_faults(const nlohmann::json& schema, const nlohmann::json& value) {
  return schema_faults(schema, value, schema);
}

/// A schema and all within it say nothing but what JsonSchema understands, so that nothing is passed over
/// unseen.
inline void expect_known_keywords(const nlohmann::json& schema, const std::string& place) {
  static const std::set<std::string> known = {"$ref",
                                              "type",
                                              "const",
                                              "enum",
                                              "required",
                                              "dependentRequired",
                                              "properties",
                                              "items",
                                              "minItems",
                                              "maxItems",
                                              "minimum",
                                              "maximum",
                                              "exclusiveMinimum",
                                              "multipleOf",
                                              "additionalProperties",
                                              "pattern",
                                              "minLength",
                                              "maxLength",
                                              "oneOf",
                                              "allOf",
                                              "if",
                                              "then",
                                              "not",
                                              "description",
                                              "title",
                                              "$defs",
                                              "$schema",
                                              "$id",
                                              "default"};
  if (!schema.is_object()) return;
  for (const auto& [key, value] : schema.items()) {
    // Keys of our own for readers; they say nothing of what fits.
    if (key.starts_with("x-")) continue;
    EXPECT_TRUE(known.contains(key)) << place << " has the keyword " << key;
    const bool by_name = key == "properties" || key == "$defs";
    const bool listed = key == "oneOf" || key == "allOf";
    if (by_name || listed)
      for (const auto& [name, part] : value.items())
        expect_known_keywords(part, place + "/" + key + "/" + name);
    else if (key == "items" || key == "additionalProperties" || key == "if" || key == "then" || key == "not")
      expect_known_keywords(value, place + "/" + key);
  }
}

}  // namespace ream::test
