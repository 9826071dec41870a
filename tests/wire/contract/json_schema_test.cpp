#include "support/json_schema.hpp"

#include <gtest/gtest.h>

namespace ream::test {
namespace {

using nlohmann::json;

/// The checker is only worth its trust if it refuses: one value that fits and ones that do not, per keyword.
void expect_tells_apart(const std::string& schema, const std::string& fitting,
                        const std::vector<std::string>& unfitting) {
  static const json document = json::parse(R"({"defs": {"small": {"type": "integer", "maximum": 3}}})");
  const SchemaChecker checker(document);
  EXPECT_TRUE(checker.faults(json::parse(schema), json::parse(fitting)).empty())
      << schema << " refuses " << fitting;
  for (const std::string& value : unfitting)
    EXPECT_FALSE(checker.faults(json::parse(schema), json::parse(value)).empty())
        << schema << " takes " << value;
}

TEST(SchemaChecker, TellsApart) {
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
}

TEST(SchemaChecker, RefusesKeywordsItDoesNotKnow) {
  const json document = json::object();
  EXPECT_THROW(SchemaChecker(document).faults(json::parse(R"({"multipleOf": 2})"), 4), std::logic_error);
}

}  // namespace
}  // namespace ream::test
