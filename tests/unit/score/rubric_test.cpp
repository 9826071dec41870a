#include "score/rubric.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/file.hpp"
#include "score/rubric_score.hpp"
#include "support/expect_error.hpp"
#include "support/json_schema.hpp"
#include "support/places.hpp"
#include "support/temporary_folder.hpp"

namespace ream::score {
namespace {

using test::expect_error;

const nlohmann::json metrics = {
    {"thrust_n", 60.0}, {"depth_mm", 1.5}, {"missing_n", nullptr}, {"hash", "ab"}};

class RubricTest : public testing::Test {
 protected:
  std::filesystem::path file(const nlohmann::json& rubric) {
    const auto path = folder_.path() / "rubric.json";
    write_file_atomically(path, rubric.dump());
    return path;
  }
  Rubric rubric(const nlohmann::json& criteria) {
    return load_rubric(file({{"name", "first year"}, {"version", 3}, {"criteria", criteria}}));
  }
  test::TemporaryFolder folder_;
};

TEST_F(RubricTest, PointsRiseFromNoneToFullInEitherDirection) {
  const auto points = [&](double none, double full) {
    return *apply_rubric(rubric({{{"metric", "thrust_n"}, {"none", none}, {"full", full}}}), metrics).points;
  };
  EXPECT_DOUBLE_EQ(points(50.0, 70.0), 50.0);
  EXPECT_DOUBLE_EQ(points(100.0, 20.0), 50.0);
  EXPECT_DOUBLE_EQ(points(80.0, 60.0), 100.0);
  EXPECT_DOUBLE_EQ(points(80.0, 70.0), 100.0) << "better than full is full";
  EXPECT_DOUBLE_EQ(points(60.0, 20.0), 0.0);
  EXPECT_DOUBLE_EQ(points(40.0, 20.0), 0.0) << "worse than none is none";
}

TEST_F(RubricTest, FilesOfTheFirstFormAreStillRead) {
  const Rubric r = rubric({{{"metric", "thrust_n"}, {"none", 100}, {"full", 20}, {"weight", 3}}});
  EXPECT_EQ(r.name, "first year");
  EXPECT_EQ(r.version, 3);
  EXPECT_FALSE(r.pass_points);
  EXPECT_FALSE(r.criteria[0].critical);
  EXPECT_EQ(r.criteria[0].ramp->none, 100.0);
  EXPECT_EQ(r.criteria[0].weight, 3.0);
}

TEST_F(RubricTest, IsWrittenAsItIsRead) {
  const nlohmann::json whole = {{"name", "all"},
                                {"version", 7},
                                {"remark", "by hand"},
                                {"pass_points", 60.0},
                                {"least_said_percent", 40.0},
                                {"criteria",
                                 {{{"metric", "thrust_n"}, {"none", 9.0}, {"full", 1.0}, {"weight", 2.0}},
                                  {{"metric", "depth_mm"},
                                   {"weight", 1.0},
                                   {"critical", true},
                                   {"band", {{"better", "less"}, {"pass", 2.0}, {"warn", 3.0}}}},
                                  {{"metric", "missing_n"},
                                   {"weight", 1.0},
                                   {"band", {{"better", "between"}, {"low", 1.0}, {"pass", 3.0}}}},
                                  {{"metric", "version_error_deg"}, {"weight", 1.0}}}}};
  EXPECT_EQ(rubric_json(load_rubric(file(whole))), whole);
  const nlohmann::json schema = read_json_file(test::source_folder() + "/proto/rubric.schema.json");
  EXPECT_EQ(test::schema_faults(schema, whole), std::vector<std::string>{});
}

TEST_F(RubricTest, HashTellsRubricsApart) {
  const nlohmann::json one = {{{"metric", "thrust_n"}, {"none", 100}, {"full", 20}}};
  const Rubric a = rubric(one);
  Rubric b = a;
  EXPECT_EQ(rubric_hash(a), rubric_hash(b));
  b.criteria[0].weight = 2.0;
  EXPECT_NE(rubric_hash(a), rubric_hash(b));
  b = a;
  b.version = 4;
  EXPECT_NE(rubric_hash(a), rubric_hash(b));
}

TEST(StandardRubric, JudgesByMetricsOfTheCatalogue) {
  const Rubric& standard = standard_rubric();
  const nlohmann::json schema = read_json_file(test::source_folder() + "/proto/rubric.schema.json");
  EXPECT_EQ(test::schema_faults(schema, rubric_json(standard)), std::vector<std::string>{});
  for (const Criterion& c : standard.criteria) EXPECT_NE(find_metric(c.metric), nullptr) << c.metric;
  EXPECT_TRUE(std::any_of(standard.criteria.begin(), standard.criteria.end(),
                          [](const Criterion& c) { return c.metric == "vault_breach_mm" && c.critical; }));
}

TEST_F(RubricTest, UnusableRubricsAreRefusedByName) {
  const nlohmann::json one = {{"metric", "thrust_n"}, {"none", 0}, {"full", 1}};
  const auto refused = [&](const nlohmann::json& rubric_json, const std::string& word) {
    expect_error(ErrorKind::invalid_input, word, [&] { load_rubric(file(rubric_json)); });
  };
  refused({{"version", 1}, {"criteria", {one}}}, "name");
  refused({{"name", "a"}, {"version", 0}, {"criteria", {one}}}, "version");
  refused({{"name", "a"}, {"version", 1}, {"criteria", nlohmann::json::array()}}, "criteria");
  refused({{"name", "a"}, {"version", 1}, {"criteria", {{{"metric", "x"}, {"none", 1}, {"full", 1}}}}},
          "full");
  refused({{"name", "a"}, {"version", 1}, {"criteria", {one}}, {"extra", 1}}, "extra");
  const auto criterion_refused = [&](const nlohmann::json& criterion, const std::string& word) {
    refused({{"name", "a"}, {"version", 1}, {"criteria", {criterion}}}, word);
  };
  criterion_refused({{"metric", "thrust_n"}}, "thrust_n");
  criterion_refused({{"metric", "thrust_n"}, {"none", 1}}, "full");
  criterion_refused({{"metric", "thrust_n"}, {"none", 1}, {"full", 2}, {"critical", true}}, "critical");
  criterion_refused({{"metric", "a"}, {"band", {{"better", "less"}, {"pass", 2}, {"warn", 1}}}}, "warn");
  criterion_refused({{"metric", "a"}, {"band", {{"better", "more"}, {"pass", 1}, {"warn", 2}}}}, "warn");
  criterion_refused({{"metric", "a"}, {"band", {{"better", "between"}, {"pass", 1}, {"low", 1}}}}, "low");
  criterion_refused({{"metric", "a"}, {"band", {{"better", "worse"}, {"pass", 1}, {"warn", 2}}}}, "better");
  refused({{"name", "a"}, {"version", 1}, {"criteria", {one, one}}}, "second time");
  for (const char* absent : {"hash", "nothing"})
    expect_error(ErrorKind::invalid_input, absent, [&] {
      apply_rubric(rubric({{{"metric", absent}, {"none", 0}, {"full", 1}}}), metrics);
    });
}

}  // namespace
}  // namespace ream::score
