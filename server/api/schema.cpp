#include "api/schema.hpp"

#include <algorithm>
#include <map>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

#include "api/schema_words.hpp"
#include "core/error.hpp"
#include "core/json.hpp"

namespace ream::api {
using nlohmann::json;
using Adapter = valijson::adapters::NlohmannJsonAdapter;
namespace {

/// In the words of draft 7, which the library knows: 3.0 is a whole number there too.
json in_draft_7(const json& schema) {
  if (schema.is_array()) {
    json list = json::array();
    for (const json& item : schema) list.push_back(in_draft_7(item));
    return list;
  }
  if (!schema.is_object()) return schema;
  json object = json::object();
  for (const auto& [key, value] : schema.items())
    object[key == "dependentRequired" ? "dependencies" : key] = in_draft_7(value);
  const auto type = object.find("type");
  if (type == object.end()) return object;
  bool whole = false;
  const auto make_number = [&](json& word) {
    if (word != "integer") return;
    word = "number";
    whole = true;
  };
  if (type->is_array())
    std::for_each(type->begin(), type->end(), make_number);
  else
    make_number(*type);
  if (whole) object["multipleOf"] = 1.0;
  return object;
}

/// Puts into `whole` what `part` refers to, and what that refers to.
void take_along(const json& part, const json& document, json& whole) {
  if (part.is_object() && part.contains("$ref") && part["$ref"].is_string()) {
    const json::json_pointer where(part["$ref"].get<std::string>().substr(1));
    if (whole.contains(where)) return;
    whole[where] = in_draft_7(document.at(where));
    take_along(document.at(where), document, whole);
  }
  if (part.is_structured())
    for (const json& inner : part) take_along(inner, document, whole);
}

/// "<root>", "[place_mm]", "[2]" as {"place_mm", "2"}.
std::vector<std::string> place_of(const std::vector<std::string>& context) {
  std::vector<std::string> place;
  for (const std::string& step : context)
    if (step.size() > 1 && step.front() == '[') place.push_back(step.substr(1, step.size() - 2));
  return place;
}

/// The key that the library names between quotes, from behind `mark` on; it may hold quotes itself.
std::string key_in(const std::string& words, const std::string& mark) {
  const size_t begin = words.find(mark) + mark.size(), end = words.rfind('\'');
  return words.substr(begin, end - begin);
}

/// A JSON pointer as a URI fragment (RFC 6901).
std::string pointer_to(const std::vector<std::string>& place) {
  std::string pointer = "#";
  for (const std::string& step : place) {
    pointer += '/';
    for (const char c : step) pointer += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
  }
  return pointer;
}

std::string name_of(const std::vector<std::string>& place) {
  std::string name;
  for (const std::string& step : place) name += (name.empty() ? "" : "/") + step;
  return place.empty() ? "it" : "'" + name + "'";
}

/// Whether `a` is where `b` is, or further out.
bool contains(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  return a.size() <= b.size() && std::equal(a.begin(), a.end(), b.begin());
}

}  // namespace

struct Schema::Parts {
  json document;  ///< the schema under "allOf", beside the components that it refers to
  valijson::Schema schema;
};

Schema::Schema(const json& schema, const json& document) {
  auto parts = std::make_unique<Parts>();
  try {
    parts->document = in_draft_7({{"allOf", json::array({schema})}});
    take_along(schema, document, parts->document);
    valijson::SchemaParser().populateSchema(Adapter(parts->document), parts->schema);
  } catch (const std::exception& error) {
    throw Error(ErrorKind::invalid_input, std::string("no schema can be made of this: ") + error.what());
  }
  parts_ = std::move(parts);
}

Schema::~Schema() = default;
Schema::Schema(Schema&&) noexcept = default;

std::vector<net::FieldError> Schema::faults(const json& value) const {
  valijson::ValidationResults results;
  valijson::Validator validator;
  if (validator.validate(parts_->schema, Adapter(value), &results)) return {};
  std::map<std::vector<std::string>, std::string> words;  // by place; what is missing or unknown has one
  valijson::ValidationResults::Error error;
  std::vector<std::vector<std::string>> broken;
  while (results.popError(error)) {
    std::vector<std::string> place = place_of(error.context);
    const std::string& what = error.description;
    const bool missing = what.starts_with("Missing "), unknown = what.starts_with("Object contains");
    if (what.starts_with("Failed to validate")) continue;
    if (!missing && !unknown) {
      broken.push_back(std::move(place));
      continue;
    }
    place.push_back(key_in(what, missing ? "'" : ": '"));
    words[place] = missing ? "is missing" : "is not a known key";
  }
  for (const auto& place : broken) {
    const auto further_in = [&](const auto& other) { return other != place && contains(place, other); };
    if (std::any_of(broken.begin(), broken.end(), further_in)) continue;
    const json* rule = schema_at(parts_->document, parts_->document, place);
    words.emplace(place, rule ? rule_words(parts_->document, *rule) : "cannot be used");
  }
  std::vector<net::FieldError> found;
  for (const auto& [place, word] : words) found.push_back({pointer_to(place), name_of(place) + " " + word});
  if (found.empty()) found.push_back({"#", "it cannot be used"});
  return found;
}

}  // namespace ream::api
