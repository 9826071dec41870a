#include "core/json_schema.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <regex>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "core/json.hpp"
#include "core/json_schema_words.hpp"
#include "core/text.hpp"

namespace ream {
using nlohmann::json;
namespace {

/// Keys and indices from the whole value on.
using Place = std::vector<std::string>;

constexpr size_t max_pattern_text = 4096;  ///< bytes; std::regex goes down its stack for each
constexpr size_t max_shown_step = 100;     ///< bytes of a key that are shown

/// Bits of a set of types.
struct Types {
  enum : unsigned { null = 1, boolean = 2, integer = 4, number = 8, string = 16, array = 32, object = 64 };
};

/// What one schema asks, read once.
struct Rule {
  unsigned types = 0;  ///< 0: any
  double least = -HUGE_VAL, most = HUGE_VAL, above = -HUGE_VAL, multiple_of = 0.0;
  size_t min_length = 0, max_length = SIZE_MAX, min_items = 0, max_items = SIZE_MAX;
  std::optional<std::regex> pattern;
  json values;  ///< of "enum" or "const"; null: any
  std::vector<std::string> required;
  std::map<std::string, std::vector<std::string>> dependent;
  std::map<std::string, const Rule*> properties;
  bool closed = false;           ///< to keys that are no properties
  const Rule* others = nullptr;  ///< of keys that are no properties
  const Rule* items = nullptr;
  const Rule *unless = nullptr, *condition = nullptr, *then = nullptr;
  std::vector<const Rule*> all_of, one_of;
};

unsigned type_of(const std::string& name) {
  static const std::map<std::string, unsigned> types = {
      {"null", Types::null},       {"boolean", Types::boolean},
      {"integer", Types::integer}, {"number", Types::number | Types::integer},
      {"string", Types::string},   {"array", Types::array},
      {"object", Types::object}};
  return types.at(name);
}

/// 3.0 is a whole number too.
unsigned type_of(const json& value) {
  switch (value.type()) {
    case json::value_t::null: return Types::null;
    case json::value_t::boolean: return Types::boolean;
    case json::value_t::number_integer:
    case json::value_t::number_unsigned: return Types::integer;
    case json::value_t::number_float:
      return value.get<double>() == std::floor(value.get<double>()) ? Types::integer : Types::number;
    case json::value_t::string: return Types::string;
    case json::value_t::array: return Types::array;
    case json::value_t::object: return Types::object;
    default: return 0;
  }
}

const json& referred(const json& document, const json& reference) {
  return document.at(json::json_pointer(reference.get<std::string>().substr(1)));
}

/// The rules of a schema and of all that it refers to.
class RuleBook {
 public:
  const Rule* add(const json& schema, const json& document);

 private:
  void read(const json& schema, const json& document, Rule& rule);
  static void read_numbers(const json& schema, Rule& rule);
  void read_parts(const json& schema, const json& document, Rule& rule);

  std::deque<Rule> rules_;
  std::map<std::string, Rule*> by_reference_;
};

const Rule* RuleBook::add(const json& schema, const json& document) {
  if (!schema.contains("$ref")) {
    Rule& rule = rules_.emplace_back();
    read(schema, document, rule);
    return &rule;
  }
  const auto [known, is_new] = by_reference_.emplace(schema["$ref"].get<std::string>(), nullptr);
  if (is_new) {
    known->second = &rules_.emplace_back();  // known from here on: further in it may refer to itself
    read(referred(document, schema["$ref"]), document, *known->second);
  }
  return known->second;
}

void RuleBook::read(const json& schema, const json& document, Rule& rule) {
  if (schema.contains("$ref")) {
    rule.all_of = {add(schema, document)};
    return;
  }
  const json types = schema.value("type", json::array());
  for (const json& type : types.is_array() ? types : json::array({types}))
    rule.types |= type_of(type.get<std::string>());
  read_numbers(schema, rule);
  read_parts(schema, document, rule);
}

void RuleBook::read_numbers(const json& schema, Rule& rule) {
  rule.least = schema.value("minimum", rule.least);
  rule.most = schema.value("maximum", rule.most);
  rule.above = schema.value("exclusiveMinimum", rule.above);
  rule.multiple_of = schema.value("multipleOf", rule.multiple_of);
  rule.min_length = schema.value("minLength", rule.min_length);
  rule.max_length = schema.value("maxLength", rule.max_length);
  rule.min_items = schema.value("minItems", rule.min_items);
  rule.max_items = schema.value("maxItems", rule.max_items);
  if (schema.contains("pattern")) rule.pattern.emplace(schema["pattern"].get<std::string>());
  rule.values = schema.contains("const") ? json::array({schema["const"]}) : schema.value("enum", json());
  rule.required = schema.value("required", rule.required);
  rule.dependent = schema.value("dependentRequired", rule.dependent);
}

void RuleBook::read_parts(const json& schema, const json& document, Rule& rule) {
  const auto part = [&](const char* keyword) {
    return schema.contains(keyword) ? add(schema[keyword], document) : nullptr;
  };
  const json properties = schema.value("properties", json::object());
  for (const auto& [key, property] : properties.items())
    rule.properties.emplace(key, add(property, document));
  const auto others = schema.find("additionalProperties");
  rule.closed = others != schema.end() && *others == false;
  if (others != schema.end() && others->is_object()) rule.others = add(*others, document);
  rule.items = part("items");
  rule.unless = part("not");
  rule.condition = part("if");
  rule.then = part("then");
  for (const json& one : schema.value("allOf", json::array())) rule.all_of.push_back(add(one, document));
  for (const json& one : schema.value("oneOf", json::array())) rule.one_of.push_back(add(one, document));
}

/// Puts into `whole` what `part` refers to, and what that refers to.
void take_along(const json& part, const json& document, json& whole) {
  if (part.is_object() && part.contains("$ref") && part["$ref"].is_string()) {
    const json::json_pointer where(part["$ref"].get<std::string>().substr(1));
    if (whole.contains(where)) return;
    whole[where] = document.at(where);
    take_along(document.at(where), document, whole);
  }
  if (part.is_structured())
    for (const json& inner : part) take_along(inner, document, whole);
}

/// A key or an index for people: of bounded length, on one line.
std::string shown_step(const std::string& step) {
  size_t end = std::min(step.size(), max_shown_step);
  while (end < step.size() && end > 0 && (static_cast<unsigned char>(step[end]) & 0xc0) == 0x80) --end;
  std::string text = step.substr(0, end);
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  return end < step.size() ? text + "..." : text;
}

SchemaFault fault_at(const Place& place, const std::string& words) {
  std::string pointer = "#", name;
  for (const std::string& step : place) {
    pointer += pointer_to(shown_step(step)).substr(1);
    name += (name.empty() ? "" : "/") + shown_step(step);
  }
  return {pointer, (place.empty() ? "it" : "'" + name + "'") + " " + words};
}

bool is_among(const json& values, const json& value) {
  return std::find(values.begin(), values.end(), value) != values.end();
}

bool number_fits(const Rule& rule, double number) {
  const bool multiple = rule.multiple_of == 0.0 || std::remainder(number, rule.multiple_of) == 0.0;
  return number >= rule.least && number <= rule.most && number > rule.above && multiple;
}

bool text_fits(const Rule& rule, const std::string& text) {
  const size_t length = characters(text);
  if (length < rule.min_length || length > rule.max_length) return false;
  return !rule.pattern || (text.size() <= max_pattern_text && std::regex_search(text, *rule.pattern));
}

/// Whether a value fits, but for what is within it.
bool shell_fits(const Rule& rule, const json& value) {
  if (rule.types != 0 && (rule.types & type_of(value)) == 0) return false;
  if (rule.values.is_array() && !is_among(rule.values, value)) return false;
  if (value.is_number()) return number_fits(rule, value.get<double>());
  if (value.is_string()) return text_fits(rule, value.get_ref<const std::string&>());
  return !value.is_array() || (value.size() >= rule.min_items && value.size() <= rule.max_items);
}

/// Whether a value is meant for this one of several rules: of its type, and what tells objects apart ("kind")
/// is as this rule has it.
bool is_meant(const Rule& rule, const json& value) {
  if (rule.types != 0 && (rule.types & type_of(value)) == 0) return false;
  if (!value.is_object()) return true;
  return std::all_of(rule.properties.begin(), rule.properties.end(), [&](const auto& property) {
    const auto given = value.find(property.first);
    return given == value.end() || !property.second->values.is_array() ||
           is_among(property.second->values, *given);
  });
}

/// What a key may be by all of several rules; empty where one of them does not say.
json values_of(const std::string& key, const std::vector<const Rule*>& rules) {
  json all = json::array();
  for (const Rule* rule : rules) {
    const auto property = rule->properties.find(key);
    if (property == rule->properties.end() || !property->second->values.is_array()) return json::array();
    for (const json& value : property->second->values) all.push_back(value);
  }
  return all;
}

/// Holds one value against rules.
class Check {
 public:
  explicit Check(const json& document) : document_(document) {}

  /// Whether the value fits. Names what does not, the places furthest in, unless quiet_.
  bool fits(const Rule& rule, const json& value);
  std::vector<SchemaFault> found() const;
  /// More than may be looked at: what fits() said means nothing.
  bool is_too_much() const { return steps_ > JsonSchema::max_steps; }

 private:
  bool fits_quietly(const Rule& rule, const json& value);
  bool items_fit(const Rule& rule, const json& list);
  bool members_fit(const Rule& rule, const json& members);
  bool one_fits(const Rule& rule, const json& value);
  bool refuse();
  bool refuse_key(const std::string& key, const std::string& words);
  /// No more faults are wanted.
  bool is_enough() const { return quiet_ || words_.size() >= JsonSchema::max_faults || is_too_much(); }

  const json& document_;
  Place place_;
  std::map<Place, std::string> words_;
  bool quiet_ = false;
  size_t steps_ = 0;
};

bool Check::refuse() {
  if (is_enough()) return false;
  const json* rule = schema_at(document_, document_, place_);
  words_.emplace(place_, rule ? rule_words(document_, *rule) : "cannot be used");
  return false;
}

bool Check::refuse_key(const std::string& key, const std::string& words) {
  if (is_enough()) return false;
  place_.push_back(key);
  words_.emplace(place_, words);
  place_.pop_back();
  return false;
}

bool Check::fits_quietly(const Rule& rule, const json& value) {
  const bool before = std::exchange(quiet_, true);
  const bool good = fits(rule, value);
  quiet_ = before;
  return good;
}

bool Check::fits(const Rule& rule, const json& value) {
  ++steps_;
  if (is_too_much()) return false;
  if (!shell_fits(rule, value)) return refuse();
  bool good = value.is_array() ? items_fit(rule, value) : !value.is_object() || members_fit(rule, value);
  for (const Rule* part : rule.all_of)
    if (good || !is_enough()) good = fits(*part, value) && good;
  if (!rule.one_of.empty() && (good || !is_enough())) good = one_fits(rule, value) && good;
  if (rule.unless && fits_quietly(*rule.unless, value)) return refuse();
  if (rule.condition && rule.then && fits_quietly(*rule.condition, value))
    good = fits(*rule.then, value) && good;
  return good;
}

bool Check::items_fit(const Rule& rule, const json& list) {
  bool good = true;
  for (size_t i = 0; rule.items && i < list.size() && (good || !is_enough()); ++i) {
    place_.push_back(std::to_string(i));
    good = fits(*rule.items, list[i]) && good;
    place_.pop_back();
  }
  return good;
}

bool Check::members_fit(const Rule& rule, const json& members) {
  bool good = true;
  for (const std::string& key : rule.required)
    if (!members.contains(key)) good = refuse_key(key, "is missing");
  for (const auto& [key, companions] : rule.dependent)
    for (const std::string& companion : companions)
      if (members.contains(key) && !members.contains(companion)) good = refuse_key(companion, "is missing");
  for (const auto& [key, member] : members.items()) {
    if (!good && is_enough()) break;
    const auto property = rule.properties.find(key);
    const Rule* part = property == rule.properties.end() ? rule.others : property->second;
    if (!part) {
      if (rule.closed) good = refuse_key(key, "is not a known key");
      continue;
    }
    place_.push_back(key);
    good = fits(*part, member) && good;
    place_.pop_back();
  }
  return good;
}

bool Check::one_fits(const Rule& rule, const json& value) {
  std::vector<const Rule*> fitting, meant;
  for (const Rule* one : rule.one_of) {
    if (fits_quietly(*one, value)) fitting.push_back(one);
    if (is_meant(*one, value)) meant.push_back(one);
  }
  if (fitting.size() == 1) return true;
  if (fitting.empty() && meant.size() == 1) return fits(*meant.front(), value);
  if (meant.empty() && value.is_object())
    for (const auto& [key, property] : rule.one_of.front()->properties)
      if (const json values = values_of(key, rule.one_of); !values.empty() && value.contains(key))
        return refuse_key(key, rule_words(document_, json{{"enum", values}}));
  return refuse();
}

std::vector<SchemaFault> Check::found() const {
  if (is_too_much()) return {{"#", "it holds too many values to be checked; send fewer"}};
  std::vector<SchemaFault> faults;
  for (const auto& [place, words] : words_) faults.push_back(fault_at(place, words));
  if (faults.empty()) faults.push_back({"#", "it cannot be used"});
  return faults;
}

}  // namespace

struct JsonSchema::Parts {
  json document;  ///< the schema under "allOf", beside the components that it refers to
  RuleBook rules;
  const Rule* rule = nullptr;
};

JsonSchema::JsonSchema(const json& schema, const json& document) {
  auto parts = std::make_unique<Parts>();
  try {
    parts->document = {{"allOf", json::array({schema})}};
    take_along(schema, document, parts->document);
    parts->rule = parts->rules.add(schema, document);
  } catch (const std::exception& error) {
    throw Error(ErrorKind::invalid_input, std::string("no schema can be made of this: ") + error.what());
  }
  parts_ = std::move(parts);
}

JsonSchema::~JsonSchema() = default;
JsonSchema::JsonSchema(JsonSchema&&) noexcept = default;

std::vector<SchemaFault> JsonSchema::faults(const json& value) const {
  Check check(parts_->document);
  const bool good = check.fits(*parts_->rule, value);
  return good && !check.is_too_much() ? std::vector<SchemaFault>() : check.found();
}

}  // namespace ream
