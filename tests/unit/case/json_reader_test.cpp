#include "core/json_reader.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/error.hpp"

namespace ream {
namespace {

using nlohmann::json;

std::string complaint(const auto& work) {
  try {
    work();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::invalid_input);
    return e.what();
  }
  return "";
}

TEST(JsonReader, RefusesUnknownKeysByName) {
  const json value = {{"depth_mm", 2.0}, {"deph_mm", 3.0}};
  JsonReader reader(value, "plan.json");
  EXPECT_EQ(reader.number("depth_mm"), 2.0);
  EXPECT_EQ(complaint([&] { reader.finish(); }), "plan.json: key 'deph_mm' is unknown");
  EXPECT_TRUE(reader.has("deph_mm"));
  reader.finish();
}

TEST(JsonReader, NamesPlaceAndKey) {
  const json value = {{"a", "x"}, {"b", {1, 2}}, {"c", 5}, {"o", {{"n", 1.5}}}};
  JsonReader reader(value, "f");
  EXPECT_EQ(complaint([&] { reader.number("missing"); }), "f: key 'missing' is missing");
  EXPECT_EQ(complaint([&] { reader.number("a"); }), "f: key 'a' must be a number");
  EXPECT_EQ(complaint([&] { reader.numbers("b", 3); }), "f: key 'b' must be a list of 3 numbers");
  EXPECT_EQ(complaint([&] { reader.number("c", 0, 4); }), "f: key 'c' is 5, must be between 0 and 4");
  JsonReader inner = reader.object("o");
  EXPECT_EQ(complaint([&] { inner.integer("n"); }), "f.o: key 'n' must be a whole number");
  EXPECT_EQ(complaint([&] { JsonReader(value["b"], "f"); }), "f must be a JSON object");
}

TEST(JsonReader, RefusesHugeIntegers) {
  const json value = {{"n", UINT64_MAX}};
  JsonReader reader(value, "f");
  EXPECT_NE(complaint([&] { reader.integer("n"); }), "");
}

}  // namespace
}  // namespace ream
