#include "core/json_schema_words.hpp"

#include "core/json.hpp"

namespace ream {
using nlohmann::json;
namespace {

const json& followed(const json& document, const json& schema) {
  const json* found = &schema;
  while (found->is_object() && found->contains("$ref"))
    found = &document.at(json::json_pointer(found->at("$ref").get<std::string>().substr(1)));
  return *found;
}

/// The part of a schema that is about one key or index.
const json* part_of(const json& schema, const std::string& step) {
  const auto properties = schema.find("properties");
  if (properties != schema.end() && properties->contains(step)) return &properties->at(step);
  const auto items = schema.find("items");
  return items != schema.end() ? &*items : nullptr;
}

std::string number_words(const json& number) {
  const std::string text = number.dump();
  return text.ends_with(".0") ? text.substr(0, text.size() - 2) : text;
}

std::string range_words(const json& schema) {
  const bool above = schema.contains("exclusiveMinimum"), least = schema.contains("minimum");
  std::string words;
  if (above) words = " above " + number_words(schema["exclusiveMinimum"]);
  if (least && schema.contains("maximum"))
    return " from " + number_words(schema["minimum"]) + " to " + number_words(schema["maximum"]);
  if (least) words = " of at least " + number_words(schema["minimum"]);
  if (schema.contains("maximum"))
    words += (words.empty() ? " of at most " : " and at most ") + number_words(schema["maximum"]);
  return words;
}

std::string count_words(const json& schema, const char* min_key, const char* max_key, const char* unit) {
  const bool least = schema.contains(min_key), most = schema.contains(max_key);
  if (least && most && schema[min_key] == schema[max_key])
    return " of " + schema[min_key].dump() + " " + unit;
  if (least && most) return " of " + schema[min_key].dump() + " to " + schema[max_key].dump() + " " + unit;
  if (least) return " of at least " + schema[min_key].dump() + " " + unit;
  return most ? " of at most " + schema[max_key].dump() + " " + unit : "";
}

std::string type_words(const json& schema, const std::string& type) {
  if (type == "integer") return "a whole number" + range_words(schema);
  if (type == "number") return "a number" + range_words(schema);
  if (type == "string" && schema.contains("pattern"))
    return "a text that matches " + schema["pattern"].get<std::string>();
  if (type == "string") return "a text" + count_words(schema, "minLength", "maxLength", "characters");
  if (type == "array") return "a list" + count_words(schema, "minItems", "maxItems", "items");
  if (type == "object") return "an object";
  return type == "boolean" ? "true or false" : "null";
}

std::string joined(const std::vector<std::string>& words) {
  std::string all;
  for (const std::string& one : words) all += (all.empty() ? "" : " or ") + one;
  return all;
}

std::string kind_words(const json& document, const json& unresolved) {
  const json& schema = followed(document, unresolved);
  std::vector<std::string> words;
  if (schema.contains("const")) return schema["const"].dump();
  for (const json& value : schema.value("enum", json::array())) words.push_back(value.dump());
  for (const char* parts : {"oneOf", "allOf"})
    for (const json& part : schema.value(parts, json::array())) words.push_back(kind_words(document, part));
  if (!words.empty()) return joined(words);
  const json type = schema.value("type", json());
  if (type.is_string()) return type_words(schema, type);
  for (const json& one : type) words.push_back(type_words(schema, one));
  return joined(words);
}

}  // namespace

const json* schema_at(const json& document, const json& unresolved, const std::vector<std::string>& place) {
  const json& schema = followed(document, unresolved);
  if (place.empty()) return &schema;
  if (const json* part = part_of(schema, place.front()))
    return schema_at(document, *part, {place.begin() + 1, place.end()});
  for (const char* choices : {"oneOf", "allOf"}) {
    if (!schema.contains(choices)) continue;
    for (const json& choice : schema[choices])
      if (const json* found = schema_at(document, choice, place)) return found;
  }
  return nullptr;
}

std::string rule_words(const json& document, const json& schema) {
  const std::string words = kind_words(document, schema);
  return words.empty() ? "cannot be used" : "must be " + words;
}

}  // namespace ream
