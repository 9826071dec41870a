#include "support/json_schema.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <set>
#include <stdexcept>

namespace ream::test {
using nlohmann::json;
namespace {

json scalar(const YAML::Node& node) {
  const std::string text = node.Scalar();
  if (node.Tag() == "!") return text;  // quoted
  if (text == "null" || text == "~" || text.empty()) return nullptr;
  if (text == "true" || text == "false") return text == "true";
  static const std::regex number("-?[0-9]+(\\.[0-9]+)?([eE][-+]?[0-9]+)?");
  return std::regex_match(text, number) ? json::parse(text) : json(text);
}

json convert(const YAML::Node& node) {
  if (node.IsSequence()) {
    json list = json::array();
    for (const YAML::Node& item : node) list.push_back(convert(item));
    return list;
  }
  if (node.IsMap()) {
    json object = json::object();
    for (const auto& pair : node) {
      const auto key = pair.first.as<std::string>();
      if (object.contains(key)) throw std::runtime_error("key '" + key + "' is there twice");
      object[key] = convert(pair.second);
    }
    return object;
  }
  return node.IsNull() ? json(nullptr) : scalar(node);
}

bool has_type(const json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "null") return value.is_null();
  if (type == "number") return value.is_number();
  if (type == "integer")
    return value.is_number_integer() ||
           (value.is_number() && value.get<double>() == std::floor(value.get<double>()));
  throw std::logic_error("unknown type '" + type + "' in a schema");
}

bool has_any_type(const json& value, const json& types) {
  if (types.is_string()) return has_type(value, types.get<std::string>());
  return std::any_of(types.begin(), types.end(),
                     [&](const json& type) { return has_type(value, type.get<std::string>()); });
}

/// Lengths are in characters, not bytes.
void check_length(const json& schema, const json& value, const std::string& at,
                  std::vector<std::string>& faults) {
  const auto text = value.get<std::string>();
  const auto length = static_cast<size_t>(
      std::count_if(text.begin(), text.end(), [](unsigned char c) { return (c & 0xc0) != 0x80; }));
  if (length < schema.value("minLength", size_t{0})) faults.push_back(at + ": is too short");
  if (length > schema.value("maxLength", length)) faults.push_back(at + ": is too long");
}

void require_known_keywords(const json& schema) {
  static const std::set<std::string> known = {"$ref",        "type",
                                              "const",       "enum",
                                              "required",    "dependentRequired",
                                              "properties",  "additionalProperties",
                                              "items",       "minItems",
                                              "maxItems",    "minimum",
                                              "maximum",     "exclusiveMinimum",
                                              "pattern",     "minLength",
                                              "maxLength",   "oneOf",
                                              "allOf",       "if",
                                              "then",        "not",
                                              "description", "title",
                                              "$defs",       "$schema",
                                              "$id",         "default"};
  for (const auto& [key, value] : schema.items())
    if (!known.contains(key))
      throw std::logic_error("the checker does not know the schema keyword '" + key + "'");
}

}  // namespace

json read_yaml(const std::filesystem::path& file) { return convert(YAML::LoadFile(file.string())); }

const json& SchemaChecker::resolve(const json& schema) const {
  if (!schema.is_object() || !schema.contains("$ref")) return schema;
  const auto reference = schema["$ref"].get<std::string>();
  if (reference.rfind("#/", 0) != 0) throw std::logic_error("cannot follow " + reference);
  return resolve(document_.at(json::json_pointer(reference.substr(1))));
}

std::vector<std::string> SchemaChecker::faults(const json& schema, const json& value) const {
  std::vector<std::string> found;
  check(schema, value, "#", found);
  return found;
}

void SchemaChecker::check(const json& unresolved, const json& value, const std::string& at,
                          std::vector<std::string>& faults) const {
  require_known_keywords(unresolved);
  const json& schema = resolve(unresolved);
  require_known_keywords(schema);
  const auto complain = [&](const std::string& what) { faults.push_back(at + ": " + what); };
  if (schema.contains("type") && !has_any_type(value, schema["type"])) {
    complain("must be " + schema["type"].dump() + ", is " + value.dump());
    return;
  }
  if (schema.contains("const") && value != schema["const"]) complain("must be " + schema["const"].dump());
  if (schema.contains("enum") &&
      std::find(schema["enum"].begin(), schema["enum"].end(), value) == schema["enum"].end())
    complain(value.dump() + " is none of " + schema["enum"].dump());
  if (schema.contains("oneOf")) check_one_of(schema, value, at, faults);
  for (const json& part : schema.value("allOf", json::array())) check(part, value, at, faults);
  check_condition(schema, value, at, faults);
  if (value.is_number()) {
    const double number = value.get<double>();
    if (schema.contains("minimum") && number < schema["minimum"].get<double>()) complain("is too small");
    if (schema.contains("maximum") && number > schema["maximum"].get<double>()) complain("is too large");
    if (schema.contains("exclusiveMinimum") && number <= schema["exclusiveMinimum"].get<double>())
      complain("is too small");
  }
  if (value.is_string()) check_length(schema, value, at, faults);
  if (value.is_string() && schema.contains("pattern") &&
      !std::regex_search(value.get<std::string>(), std::regex(schema["pattern"].get<std::string>())))
    complain(value.dump() + " does not match " + schema["pattern"].dump());
  if (value.is_object()) check_object(schema, value, at, faults);
  if (value.is_array()) check_array(schema, value, at, faults);
}

void SchemaChecker::check_condition(const json& schema, const json& value, const std::string& at,
                                    std::vector<std::string>& faults) const {
  const auto fits = [&](const json& part) {
    std::vector<std::string> of_part;
    check(part, value, at, of_part);
    return of_part.empty();
  };
  if (schema.contains("not") && fits(schema["not"])) faults.push_back(at + ": fits what it must not fit");
  if (schema.contains("if") && schema.contains("then") && fits(schema["if"]))
    check(schema["then"], value, at, faults);
}

void SchemaChecker::check_object(const json& schema, const json& value, const std::string& at,
                                 std::vector<std::string>& faults) const {
  for (const json& key : schema.value("required", json::array()))
    if (!value.contains(key.get<std::string>())) faults.push_back(at + ": lacks " + key.get<std::string>());
  const json dependent = schema.value("dependentRequired", json::object());
  for (const auto& [key, others] : dependent.items())
    for (const json& other : others)
      if (value.contains(key) && !value.contains(other.get<std::string>()))
        faults.push_back(at + ": lacks " + other.get<std::string>() + ", which " + key + " needs");
  const json properties = schema.value("properties", json::object());
  for (const auto& [key, member] : value.items()) {
    const json others = schema.value("additionalProperties", json(true));
    if (properties.contains(key))
      check(properties[key], member, at + "/" + key, faults);
    else if (others.is_object())
      check(others, member, at + "/" + key, faults);
    else if (others == false)
      faults.push_back(at + ": must not have " + key);
  }
}

void SchemaChecker::check_array(const json& schema, const json& value, const std::string& at,
                                std::vector<std::string>& faults) const {
  if (value.size() < schema.value("minItems", size_t{0})) faults.push_back(at + ": has too few items");
  if (value.size() > schema.value("maxItems", value.size())) faults.push_back(at + ": has too many items");
  if (!schema.contains("items")) return;
  for (size_t i = 0; i < value.size(); ++i)
    check(schema["items"], value[i], at + "/" + std::to_string(i), faults);
}

void SchemaChecker::check_one_of(const json& schema, const json& value, const std::string& at,
                                 std::vector<std::string>& faults) const {
  int fitting = 0;
  std::vector<std::string> why;
  for (const json& choice : schema["oneOf"]) {
    std::vector<std::string> of_choice;
    check(choice, value, at, of_choice);
    fitting += of_choice.empty() ? 1 : 0;
    why.insert(why.end(), of_choice.begin(), of_choice.end());
  }
  if (fitting == 1) return;
  faults.push_back(at + ": fits " + std::to_string(fitting) + " of its choices");
  faults.insert(faults.end(), why.begin(), why.end());
}

}  // namespace ream::test
