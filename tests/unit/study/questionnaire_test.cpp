#include "study/questionnaire.hpp"
#include "support/places.hpp"

#include <gtest/gtest.h>

#include <random>

#include "api/yaml_json.hpp"
#include "core/file.hpp"
#include "support/expect_error.hpp"
#include "support/json_schema.hpp"

namespace ream::study {
namespace {

using nlohmann::json;
using test::expect_error;

const std::filesystem::path proto = std::filesystem::path(test::source_folder()) / "proto";

json small() {
  return json::parse(R"({
    "id": "mine_1", "title": "Mine", "items": [
      {"id": "force", "kind": "likert", "words": "The force is real.", "points": 7, "cannot_judge": true},
      {"id": "looks", "kind": "likert", "words": "It looks real.", "points": 5},
      {"id": "hand", "kind": "choice", "words": "Which hand?", "required": false,
       "options": [{"id": "left", "words": "Left"}, {"id": "right", "words": "Right"}]},
      {"id": "tools", "kind": "choice", "words": "Which tools?", "several": true,
       "options": [{"id": "saw", "words": "Saw"}, {"id": "drill", "words": "Drill"}]},
      {"id": "remarks", "kind": "text", "words": "Anything else?", "longest": 10}]})");
}

std::vector<std::string> pointers(const json& answers) {
  std::vector<std::string> list;
  for (const auto& fault : faults_of_answers(questionnaire_from(small()), answers))
    list.push_back(fault.pointer);
  return list;
}
using Pointers = std::vector<std::string>;

bool taken(const json& value) {
  try {
    questionnaire_from(value);
    return true;
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::invalid_input);
    EXPECT_NE(std::string(error.what()).find("questionnaire"), std::string::npos) << error.what();
    return false;
  }
}

TEST(Questionnaire, OursIsAsTheSchemaSaysAndAsksForWhatMatters) {
  const json file = read_json_file(proto / "questionnaires/face_validity_1.json");
  const json schema = read_json_file(proto / "questionnaire.schema.json");
  EXPECT_EQ(test::schema_faults(schema, file), std::vector<std::string>());
  EXPECT_EQ(test::schema_faults(schema, to_json(face_validity_questionnaire())), std::vector<std::string>());
  std::set<std::string> ids;
  for (const auto& item : face_validity_questionnaire().items) ids.insert(item.id);
  for (const char* asked : {"bone_appearance", "force_cortical", "force_cancellous", "vibration", "sound",
                            "visual_occlusion", "training_sequence"})
    EXPECT_TRUE(ids.contains(asked)) << asked;
}

TEST(Questionnaire, ComesBackFromItsJsonTheSame) {
  const json told = to_json(questionnaire_from(small()));
  EXPECT_EQ(to_json(questionnaire_from(told)), told);
  EXPECT_EQ(told["items"][0]["low"], "Strongly disagree");
  EXPECT_EQ(told["items"][1]["required"], true);
  EXPECT_EQ(told["items"][4]["required"], false);
}

/// What a questionnaire may be: its schema, and requests by the contract.
struct Rules {
  const json schema = read_json_file(proto / "questionnaire.schema.json");
  const json contract = api::json_from_yaml(read_text_file(proto / "openapi.yaml"));
  const JsonSchema by_schema{schema, schema};
  const JsonSchema by_contract{contract.at("components").at("schemas").at("NewQuestionnaire"), contract};

  /// Whether it fits; reader, schema and contract must agree.
  bool fits(const json& value) const {
    const bool fits = by_schema.faults(value).empty();
    EXPECT_EQ(by_contract.faults(value).empty(), fits) << value;
    EXPECT_EQ(taken(value), fits) << value;
    return fits;
  }
};

/// Every key of every part is taken away, and replaced by values of all kinds.
TEST(Questionnaire, IsReadExactlyAsTheSchemaSays) {
  const Rules rules;
  const std::vector<json> others = {nullptr,        true,         0,    5,  7.5,   "",      "a",
                                    "text",         "A b",        "de", {}, {"x"}, "en-GB", "likert",
                                    json::object(), json::array()};
  int agreed_refusals = 0;
  const auto compare = [&](const json& value) { agreed_refusals += rules.fits(value) ? 0 : 1; };
  const json flat = small().flatten();
  for (const auto& [pointer, ignored] : flat.items()) {
    json lacking = flat;
    lacking.erase(pointer);
    if (json value = lacking.unflatten(); value != small()) compare(value);
    for (const json& other : others) {
      json changed = small();
      changed[json::json_pointer(pointer)] = other;
      compare(changed);
    }
  }
  for (const char* at : {"", "/items/0", "/items/2", "/items/2/options/0", "/items/4"}) {
    json changed = small();
    changed[json::json_pointer(std::string(at) + "/unasked")] = 1;
    compare(changed);
  }
  EXPECT_GT(agreed_refusals, 100);
}

/// Lengths and counts at their limits and one beyond.
TEST(Questionnaire, HasTheLimitsOfTheSchemaAndTheContract) {
  const Rules rules;
  const auto expect_limit = [&](const std::string& place, const std::string& limit, const auto& value_of) {
    const size_t largest = rules.schema.at(json::json_pointer(limit)).get<size_t>();
    for (const size_t size : {largest, largest + 1}) {
      json changed = small();
      changed[json::json_pointer(place)] = value_of(size);
      EXPECT_EQ(rules.fits(changed), size == largest) << place << " of " << size;
    }
  };
  const auto text = [](size_t size) { return json(std::string(size, 'x')); };
  const auto many = [](const json& first) {
    return [first](size_t size) {
      json all(size, first);
      for (size_t i = 0; i < size; ++i) all[i]["id"] = "n" + std::to_string(i);
      return all;
    };
  };
  expect_limit("/title", "/properties/title/maxLength", text);
  expect_limit("/introduction", "/properties/introduction/maxLength", text);
  for (const char* place : {"/items/0/words", "/items/0/low", "/items/0/high", "/items/2/options/0/words"})
    expect_limit(place, "/$defs/words/maxLength", text);
  expect_limit("/items/0/section", "/$defs/section/maxLength", text);
  expect_limit("/items/4/longest", "/$defs/text/properties/longest/maximum",
               [](size_t size) { return json(size); });
  expect_limit("/items", "/properties/items/maxItems", many(small()["items"][0]));
  expect_limit("/items/2/options", "/$defs/choice/properties/options/maxItems",
               many(small()["items"][2]["options"][0]));
}

TEST(Questionnaire, TwoItemsOrOptionsCannotHaveOneId) {
  json twice = small();
  twice["items"][1]["id"] = "force";
  expect_error(ErrorKind::invalid_input, "items[1]", [&] { questionnaire_from(twice); });
  twice = small();
  twice["items"][2]["options"][1]["id"] = "left";
  expect_error(ErrorKind::invalid_input, "options[1]", [&] { questionnaire_from(twice); });
}

TEST(Questionnaire, TakesCompleteAnswers) {
  EXPECT_EQ(pointers({{"force", nullptr}, {"looks", 5}, {"tools", {"saw"}}}), Pointers());
  EXPECT_EQ(pointers({{"force", 7},
                      {"looks", 1},
                      {"hand", "left"},
                      {"tools", {"drill", "saw"}},
                      {"remarks", "schön – so"}}),
            Pointers());
}

TEST(Questionnaire, NamesEveryFaultOfAnswersAtOnce) {
  EXPECT_EQ(pointers(json::object()), (Pointers{"#/force", "#/looks", "#/tools"}));
  EXPECT_EQ(pointers({{"force", 8},
                      {"looks", nullptr},
                      {"hand", "both"},
                      {"tools", {"saw", "saw"}},
                      {"remarks", "eleven long"},
                      {"name/of", "x"}}),
            (Pointers{"#/force", "#/looks", "#/hand", "#/tools", "#/remarks", "#/name~1of"}));
  for (const json& value : {json(0), json(6), json(2.5), json("3"), json(true), json::array()})
    EXPECT_EQ(pointers({{"force", 1}, {"looks", value}, {"tools", {"saw"}}}), Pointers{"#/looks"}) << value;
  for (const json& value : {json("saw"), json::array(), json(nullptr), json({1}), json({"axe"})})
    EXPECT_EQ(pointers({{"force", 1}, {"looks", 1}, {"tools", value}}), Pointers{"#/tools"}) << value;
  EXPECT_EQ(pointers(json::array()), Pointers{"#"});
  EXPECT_EQ(pointers(nullptr), Pointers{"#"});
}

}  // namespace
}  // namespace ream::study
