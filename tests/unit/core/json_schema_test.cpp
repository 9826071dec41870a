#include "support/json_schema.hpp"

#include <filesystem>

#include "core/error.hpp"
#include "core/file.hpp"
#include "support/places.hpp"

namespace ream {
namespace {

using nlohmann::json;

/// A schema is only worth its trust if it refuses: one value that fits and ones that do not, per keyword.
void expect_tells_apart(const std::string& schema, const std::string& fitting,
                        const std::vector<std::string>& unfitting) {
  static const json document = json::parse(R"({"defs": {"small": {"type": "integer", "maximum": 3}}})");
  const JsonSchema checked(json::parse(schema), document);
  EXPECT_TRUE(checked.faults(json::parse(fitting)).empty()) << schema << " refuses " << fitting;
  for (const std::string& value : unfitting)
    EXPECT_FALSE(checked.faults(json::parse(value)).empty()) << schema << " takes " << value;
}

TEST(JsonSchema, TellsApart) {
  expect_tells_apart(R"({"type": "integer"})", "3", {"3.5", "\"3\"", "null", "true"});
  expect_tells_apart(R"({"type": "number"})", "3.5", {"\"3\"", "null", "[]"});
  expect_tells_apart(R"({"type": ["string", "null"]})", "null", {"3", "{}"});
  expect_tells_apart(R"({"const": "ok"})", "\"ok\"", {"\"no\""});
  expect_tells_apart(R"({"enum": ["left", "right"]})", "\"left\"", {"\"up\"", "1"});
  expect_tells_apart(R"({"minimum": 0, "maximum": 2})", "2", {"-0.1", "2.1"});
  expect_tells_apart(R"({"exclusiveMinimum": 0})", "0.1", {"0", "-1"});
  expect_tells_apart(R"({"pattern": "^[0-9a-f]{4}$"})", "\"00af\"", {"\"00aff\"", "\"00AF\""});
  expect_tells_apart(R"({"minLength": 2, "maxLength": 3})", "\"\u00e4\u00f6\u00fc\"", {"\"a\"", "\"abcd\""});
  expect_tells_apart(R"({"items": {"type": "number"}, "minItems": 2, "maxItems": 3})", "[1, 2]",
                     {"[1]", "[1,2,3,4]", "[1,null]"});
  expect_tells_apart(
      R"({"required": ["a"], "properties": {"a": {"type": "string"}}, "additionalProperties": false})",
      R"({"a": "x"})", {"{}", R"({"a": 1})", R"({"a": "x", "b": 1})"});
  expect_tells_apart(R"({"oneOf": [{"type": "null"}, {"$ref": "#/defs/small"}]})", "3", {"4", "\"x\""});
  expect_tells_apart(R"({"$ref": "#/defs/small"})", "1", {"9"});
  expect_tells_apart(R"({"allOf": [{"minimum": 1}, {"maximum": 2}]})", "2", {"0", "3"});
  expect_tells_apart(R"({"not": {"required": ["a"]}})", R"({"b": 1})", {R"({"a": 1})"});
  expect_tells_apart(R"({"dependentRequired": {"a": ["b"]}})", R"({"a": 1, "b": 1})", {R"({"a": 1})"});
  expect_tells_apart(R"({"additionalProperties": {"type": "integer"}})", R"({"a": 1})", {R"({"a": "x"})"});
  expect_tells_apart(
      R"({"if": {"properties": {"kind": {"const": "box"}}, "required": ["kind"]}, "then": {"required": ["edge"]}})",
      R"({"kind": "box", "edge": 1})", {R"({"kind": "box"})"});
}

TEST(JsonSchema, NamesAKeyThatOneFormKnowsNotWithinOneThatAnotherDoesNot) {
  const json schema = json::parse(R"({"oneOf": [
      {"properties": {"a": {"type": "object", "properties": {}, "additionalProperties": false}},
       "additionalProperties": false},
      {"properties": {"b": {"type": "null"}}, "additionalProperties": false}]})");
  EXPECT_FALSE(JsonSchema(schema, schema).faults(json::parse(R"({"a": {"c": {"d": 1}}, "e": 2})")).empty());
}

/// Faults of a value, "pointer: words" each.
std::vector<std::string> faults_of(const std::string& schema, const json& value) {
  return test::schema_faults(json::parse(schema), value);
}

TEST(JsonSchema, NamesTwentyFaultsAtMost) {
  const json texts(1000, ""), objects(1000, json::object());
  EXPECT_EQ(faults_of(R"({"items": {"type": "number"}})", texts).size(), JsonSchema::max_faults);
  EXPECT_EQ(faults_of(R"({"items": {"required": ["a", "b"]}})", objects).size(), JsonSchema::max_faults);
  json unknown = json::object();
  for (int i = 0; i < 1000; ++i) unknown["key" + std::to_string(i)] = i;
  EXPECT_EQ(faults_of(R"({"additionalProperties": false})", unknown).size(), JsonSchema::max_faults);
  EXPECT_EQ(faults_of(R"({"additionalProperties": {"type": "string"}})", unknown).size(),
            JsonSchema::max_faults);
  EXPECT_EQ(faults_of(R"({"allOf": [{"items": {"type": "number"}}, {"maxItems": 3}]})", texts).size(),
            JsonSchema::max_faults);
}

TEST(JsonSchema, DoesNotLookIntoAListThatIsTooLong) {
  using Lines = std::vector<std::string>;
  const json texts(350'000, "");
  EXPECT_EQ(faults_of(R"({"type": "array", "maxItems": 3, "items": {"type": "number"}})", texts),
            Lines{"#: it must be a list of at most 3 items"});
  EXPECT_EQ(
      faults_of(
          R"({"oneOf": [{"type": "null"}, {"type": "array", "maxItems": 3, "items": {"type": "number"}}]})",
          texts),
      Lines{"#: it must be null or a list of at most 3 items"});
}

TEST(JsonSchema, LooksAtAMillionPlacesAtMost) {
  const std::string deep_choice =
      R"({"$ref": "#/$defs/any", "$defs": {"any": {"oneOf": [{"type": "integer"},
          {"type": "array", "items": {"$ref": "#/$defs/any"}}, {"type": "array", "items": {"type": "array"}, "minItems": 9}]}}})";
  json value = 1;
  for (int depth = 0; depth < 6; ++depth) value = json(8, value);
  EXPECT_EQ(faults_of(deep_choice, json(8, 1)).size(), 0u);
  EXPECT_EQ(faults_of(deep_choice, value),
            std::vector<std::string>{"#: it holds too many values to be checked; send fewer"});
  EXPECT_EQ(faults_of(R"({"not": {"items": {"type": "string"}}})", json(1'000'001, "")).size(), 1u);
}

/// std::regex goes down the stack with the length of a text.
TEST(JsonSchema, HoldsNoLongTextAgainstAPattern) {
  const json longest(std::string(1'000'000, 'a'));
  EXPECT_EQ(faults_of(R"({"type": "string", "maxLength": 8, "pattern": "^(a|b)*$"})", longest).size(), 1u);
  EXPECT_EQ(faults_of(R"({"type": "string", "pattern": "^(a|b)*$"})", longest).size(), 1u);
  EXPECT_EQ(faults_of(R"({"type": "string", "pattern": "^a*$"})", std::string(1000, 'a')).size(), 0u);
}

TEST(JsonSchema, ShowsKeysShortAndOnOneLine) {
  const json value = {{std::string(500'000, 'k'), 1}, {"two\nlines", 2}};
  for (const std::string& line : faults_of(R"({"additionalProperties": false})", value)) {
    EXPECT_LT(line.size(), 300u);
    EXPECT_EQ(line.find('\n'), line.npos);
  }
}

TEST(JsonSchema, TellsAlternativesApartByWhatTheySayOfThemselves) {
  using Lines = std::vector<std::string>;
  const std::string shapes =
      R"({"oneOf": [{"required": ["kind", "edge"], "properties": {"kind": {"const": "box"}, "edge": {"type": "number"}}},
                    {"required": ["kind", "radius"], "properties": {"kind": {"const": "ball"}, "radius": {"type": "number"}}}]})";
  EXPECT_EQ(faults_of(shapes, {{"kind", "ball"}, {"radius", 2}}), Lines{});
  EXPECT_EQ(faults_of(shapes, {{"kind", "ball"}}), Lines{"#/radius: 'radius' is missing"});
  EXPECT_EQ(faults_of(shapes, {{"kind", "ball"}, {"radius", "x"}}),
            Lines{"#/radius: 'radius' must be a number"});
  EXPECT_EQ(faults_of(shapes, {{"kind", "cone"}}), Lines{"#/kind: 'kind' must be \"box\" or \"ball\""});
}

TEST(JsonSchema, KnowsMultiplesOfWholeNumbers) {
  EXPECT_EQ(faults_of(R"({"type": "integer", "multipleOf": 8})", 16).size(), 0u);
  EXPECT_EQ(faults_of(R"({"type": "integer", "multipleOf": 8})", 12).size(), 1u);
}

TEST(JsonSchema, IsNoneOfWhatIsNoSchema) {
  EXPECT_THROW(JsonSchema(json::parse(R"({"pattern": "("})"), json::object()), Error);
  EXPECT_THROW(JsonSchema(json::parse(R"({"$ref": "#/nowhere"})"), json::object()), Error);
  EXPECT_THROW(JsonSchema(json::parse(R"({"type": "whole"})"), json::object()), Error);
}

TEST(JsonSchema, KnowsEveryKeywordOfOurs) {
  size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(test::source_folder() + "/proto"))
    if (const std::string name = entry.path().filename().string(); name.ends_with(".schema.json")) {
      test::expect_known_keywords(read_json_file(entry.path()), name);
      ++files;
    }
  EXPECT_GT(files, 10u);
}

}  // namespace
}  // namespace ream
