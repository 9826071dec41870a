#include "score/rubric.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/file.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace ream::score {
namespace {

using nlohmann::json;
using test::expect_error;

const json metrics = {{"thrust_n", 60.0}, {"depth_mm", 1.5}, {"unsaid_n", nullptr}, {"hash", "ab"}};

class RubricTest : public testing::Test {
 protected:
  std::filesystem::path file(const json& rubric) {
    const auto path = folder_.path() / "rubric.json";
    write_file_atomically(path, rubric.dump());
    return path;
  }
  Rubric rubric(const json& criteria) {
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

TEST_F(RubricTest, TheScoreIsTheWeightedMeanOfWhatIsSaid) {
  const Rubric r = rubric({{{"metric", "thrust_n"}, {"none", 100}, {"full", 20}, {"weight", 3}},
                           {{"metric", "depth_mm"}, {"none", 0}, {"full", 2}},
                           {{"metric", "unsaid_n"}, {"none", 0}, {"full", 1}, {"weight", 100}}});
  const Score score = apply_rubric(r, metrics);
  EXPECT_DOUBLE_EQ(*score.points, (3 * 50.0 + 75.0) / 4.0);
  EXPECT_FALSE(score.criteria[2].points) << "no points for what the session does not say";
  const json told = to_json(r, score);
  EXPECT_EQ(told["rubric"], "first year");
  EXPECT_EQ(told["version"], 3);
  EXPECT_TRUE(told["criteria"][2]["points"].is_null());
}

TEST_F(RubricTest, ThereIsNoScoreWhenNothingIsSaid) {
  const Score score = apply_rubric(rubric({{{"metric", "unsaid_n"}, {"none", 0}, {"full", 1}}}), metrics);
  EXPECT_FALSE(score.points);
}

TEST_F(RubricTest, UnusableRubricsAreRefusedByName) {
  const json one = {{"metric", "thrust_n"}, {"none", 0}, {"full", 1}};
  const auto refused = [&](const json& rubric_json, const std::string& word) {
    expect_error(ErrorKind::invalid_input, word, [&] { load_rubric(file(rubric_json)); });
  };
  refused({{"version", 1}, {"criteria", {one}}}, "name");
  refused({{"name", "a"}, {"version", 0}, {"criteria", {one}}}, "version");
  refused({{"name", "a"}, {"version", 1}, {"criteria", json::array()}}, "criteria");
  refused({{"name", "a"}, {"version", 1}, {"criteria", {{{"metric", "x"}, {"none", 1}, {"full", 1}}}}},
          "full");
  refused({{"name", "a"}, {"version", 1}, {"criteria", {one}}, {"extra", 1}}, "extra");
  for (const char* absent : {"hash", "nothing"})
    expect_error(ErrorKind::invalid_input, absent, [&] {
      apply_rubric(rubric({{{"metric", absent}, {"none", 0}, {"full", 1}}}), metrics);
    });
}

}  // namespace
}  // namespace ream::score
