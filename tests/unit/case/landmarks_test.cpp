#include "case/landmarks.hpp"
#include "support/places.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "core/file.hpp"
#include "support/expect_error.hpp"
#include "support/json_schema.hpp"
#include "support/shoulder_landmarks.hpp"
#include "support/temporary_folder.hpp"

namespace ream::case_ {
namespace {
using nlohmann::json;

Landmarks all_of_them() {
  Landmarks l = test::shoulder_landmarks({});
  l.biconcavity_mm = {{1.0 / 3.0, 2, 3}, {4, 5, 6}, {7, 8, 9}};
  l.walch = "B2";
  return l;
}

json schema() { return read_json_file(test::source_folder() + "/proto/landmarks.schema.json"); }

TEST(Landmarks, RoundTripKeepsEveryBitOfEverySubset) {
  const Landmarks all = all_of_them();
  const json whole = to_json(all), rules = schema();
  EXPECT_EQ(whole.size(), 10u);
  EXPECT_EQ(landmarks_from_json(whole, "l"), all);
  EXPECT_EQ(to_json(Landmarks{}), json::object());
  for (const auto& [key, ignored] : whole.items()) {
    json fewer = whole;
    fewer.erase(key);
    EXPECT_EQ(to_json(landmarks_from_json(fewer, "l")), fewer) << key;
    EXPECT_EQ(test::schema_faults(rules, fewer), std::vector<std::string>{}) << key;
  }
}

TEST(Landmarks, SchemaAndReaderRefuseTheSame) {
  const json rules = schema(), good = to_json(all_of_them());
  const std::vector<std::pair<std::string, json>> wrong{
      {"trigonum_mm", {1, 2}},
      {"trigonum_mm", {1, 2, "3"}},
      {"trigonum_mm", {1, 2, 2e5}},
      {"trigonum_mm", nullptr},
      {"humeral_head", {{"centre_mm", {1, 2, 3}}}},
      {"humeral_head", {{"centre_mm", {1, 2, 3}}, {"radius_mm", 4.0}}},
      {"humeral_head", {{"centre_mm", {1, 2, 3}}, {"radius_mm", 24.0}, {"colour", 1}}},
      {"biconcavity_mm", {{1, 2, 3}, {4, 5, 6}}},
      {"biconcavity_mm", {{1, 2, 3}, {4, 5, 6}, {7, 8}}},
      {"biconcavity_mm", 3},
      {"walch", "B4"},
      {"walch", ""},
      {"trigonum", {1, 2, 3}}};
  for (const auto& [key, value] : wrong) {
    json bad = good;
    bad[key] = value;
    EXPECT_FALSE(test::schema_faults(rules, bad).empty()) << key << " " << value;
    test::expect_error(ErrorKind::invalid_input, key, [&] { landmarks_from_json(bad, "place"); });
  }
  test::expect_error(ErrorKind::invalid_input, "place", [] { landmarks_from_json(json::array(), "place"); });
}

TEST(Landmarks, AreKeptInAFolderOrNotAtAll) {
  const test::TemporaryFolder folder;
  EXPECT_FALSE(load_landmarks(folder.path()));
  const Landmarks all = all_of_them();
  save_landmarks(all, folder.path());
  EXPECT_EQ(load_landmarks(folder.path()), all);
  Landmarks broken = all;
  broken.trigonum_mm->y() = std::numeric_limits<double>::quiet_NaN();
  test::expect_error(ErrorKind::invalid_input, "trigonum_mm", [&] { save_landmarks(broken, folder.path()); });
  broken = all;
  broken.walch = "Z";
  test::expect_error(ErrorKind::invalid_input, "walch", [&] { save_landmarks(broken, folder.path()); });
  EXPECT_EQ(load_landmarks(folder.path()), all);
  EXPECT_EQ(folder.entries(), std::vector<std::string>{"landmarks.json"});
  folder.write("landmarks.json", "{\"trigonum_mm\": [1, 2");
  test::expect_error(ErrorKind::invalid_input, "landmarks.json", [&] { load_landmarks(folder.path()); });
}

}  // namespace
}  // namespace ream::case_
