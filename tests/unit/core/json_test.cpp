#include "core/json.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "core/file.hpp"
#include "support/expect_error.hpp"
#include "support/places.hpp"

namespace ream {
namespace {

using nlohmann::json;
using test::expect_error;

std::string repeated(const std::string& text, size_t times) {
  std::string all;
  for (size_t i = 0; i < times; ++i) all += text;
  return all;
}
std::string nested(const std::string& open, const std::string& inner, const std::string& close,
                   size_t depth) {
  return repeated(open, depth) + inner + repeated(close, depth);
}

TEST(Json, SaysWhatTheLibrarySays) {
  for (const char* text : {"null", "true", " [1, -2, 3.5, 18446744073709551615, \"\\u00e4\"] ",
                           "{\"a\": {\"b\": []}, \"\": {}}"})
    EXPECT_EQ(parse_json(text), json::parse(text)) << text;
  size_t files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(test::source_folder() + "/proto"))
    if (entry.path().extension() == ".json" && ++files) {
      EXPECT_EQ(read_json_file(entry.path()), json::parse(read_text_file(entry.path()))) << entry.path();
    }
  EXPECT_GT(files, 10u);
}

TEST(Json, IsAtMostSoDeep) {
  EXPECT_EQ(parse_json(nested("[", "", "]", max_json_depth)),
            json::parse(nested("[", "", "]", max_json_depth)));
  EXPECT_NO_THROW(parse_json("[" + repeated(nested("[", "", "]", max_json_depth - 1) + ",", 100) + "1]"));
  const auto refused = [](const std::string& text) {
    expect_error(ErrorKind::invalid_input, "32 deep", [&] { parse_json(text); });
    EXPECT_TRUE(parse_json_or_discard(text).is_discarded());
  };
  refused(nested("[", "", "]", max_json_depth + 1));
  for (const size_t depth : {100'000u, 500'000u}) {
    refused(nested("[", "", "]", depth));
    refused(repeated("[", depth));
    refused(nested("{\"a\":", "1", "}", depth));
    refused(nested("{\"a\":[{\"b\":1},", "1", "]}", depth));
    refused("{\"known\":[1,2]," + repeated("\"a\":{", depth));
  }
}

TEST(Json, BracketsInTextsAndKeysAreNoDepth) {
  const std::string brackets = repeated("[{\\\"", 1000);
  EXPECT_EQ(parse_json("{\"" + brackets + "\": \"" + brackets + "\"}").size(), 1u);
}

TEST(Json, RefusesWhatIsNone) {
  for (const char* text : {"", "{", "[1,]", "{'a': 1}", "nan", "[1] x", "\xff", "\"\xc3\"", "1e5e5",
                           "// a\n1", "{\"a\" 1}", "{\"a\": 1, }", "[", "]", "\"a\nb\""})
    expect_error(ErrorKind::invalid_input, "is not valid JSON", [&] { parse_json(text); });
  expect_error(ErrorKind::invalid_input, "line 2, column 5", [] { parse_json("{\n\"a\" 1}"); });
  for (const char* number : {"1e999", "-1e999", "[1e400]"})
    expect_error(ErrorKind::invalid_input, "number too large", [&] { parse_json(number); });
  EXPECT_TRUE(parse_json_or_discard("[1,]").is_discarded());
}

TEST(Json, HasNoKeyTwice) {
  for (const char* text :
       {R"({"a": 1, "a": 1})", R"([{"b": {}, "c": 2, "b": []}])", R"({"a": 1, "\u0061": 2})"})
    expect_error(ErrorKind::invalid_input, "twice", [&] { parse_json(text); });
  EXPECT_NO_THROW(parse_json(R"([{"a": 1}, {"a": {"a": 2}}])"));
  const std::string huge(500'000, 'k');
  try {
    parse_json("{\"" + huge + "\": 1, \"" + huge + "\": 2}");
    FAIL();
  } catch (const Error& fault) {
    EXPECT_LT(std::string(fault.what()).size(), 200u);
  }
}

}  // namespace
}  // namespace ream
