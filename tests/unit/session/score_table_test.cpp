#include "session/scoring/score_table.hpp"

#include <gtest/gtest.h>

#include <set>

#include "core/file.hpp"
#include "session/scoring/score_document.hpp"
#include "support/json_schema.hpp"
#include "support/places.hpp"

namespace ream::session {
namespace {

using nlohmann::json;

json some_metrics() {
  json metrics = {{"force_scale", 26.0}, {"missing", json::object()}};
  for (const score::Metric& metric : score::metric_catalogue()) {
    metrics[std::string(metric.key)] = nullptr;
    metrics["missing"][std::string(metric.key)] = "no bone was removed";
  }
  metrics["duration_s"] = 12.5;
  return metrics;
}

TEST(ScoreTable, HasARowASessionAndNoNames) {
  const json named = {
      {"trainee", "Zoe"}, {"trainee_id", "u-7"}, {"participant", "P-03"}, {"theatre", true}, {"attempt", 2}};
  const auto table = score_table({{"a", named, some_metrics()}, {"b", json::object(), some_metrics()}},
                                 score::standard_rubric());
  ASSERT_EQ(table.rows.size(), 2u);
  for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size());
  const std::string csv = csv_of(table);
  EXPECT_EQ(csv.find("Zoe"), std::string::npos);
  EXPECT_EQ(csv.find("u-7"), std::string::npos) << "the code stands for the user";
  EXPECT_NE(csv.find("P-03"), std::string::npos);
  const json rows = json_of(table);
  EXPECT_EQ(rows[0]["theatre"], true);
  EXPECT_EQ(rows[0]["attempt"], 2);
  EXPECT_EQ(rows[0]["outcome"], "undecided");
  EXPECT_EQ(rows[0]["duration_s"], 12.5);
  EXPECT_TRUE(rows[0]["sparc"].is_null());
  EXPECT_EQ(rows[1]["device"], "script");
}

TEST(ScoreTable, ItsCodebookExplainsEveryColumn) {
  const auto table = score_table({}, score::standard_rubric());
  const auto book = score_codebook(table);
  ASSERT_EQ(book.rows.size(), table.columns.size());
  std::set<std::string> names;
  for (const auto& row : book.rows) {
    EXPECT_TRUE(names.insert(row[0].get<std::string>()).second) << row[0];
    EXPECT_FALSE(row[2].get<std::string>().empty()) << row[0];
  }
  for (const score::Metric& metric : score::metric_catalogue())
    EXPECT_TRUE(names.contains(std::string(metric.key)));
}

TEST(ScoreDocument, FitsItsSchemaAndHoldsTheRubric) {
  const json schema = read_json_file(test::source_folder() + "/proto/score.schema.json");
  const auto benchmark = std::make_shared<const score::Benchmark>(
      score::Benchmark{"ours", {}, {{"duration_s", score::Better::less, 20.0, 1.0, 3, {}}}});
  for (const auto& compared : {std::shared_ptr<const score::Benchmark>(), benchmark}) {
    const json document =
        score_document("ream", {{"theatre", true}}, some_metrics(), {score::standard_rubric(), "", compared});
    EXPECT_EQ(test::schema_faults(schema, document), std::vector<std::string>{});
    EXPECT_EQ(document["theatre"], true);
    EXPECT_EQ(document["rubric"], score::rubric_json(score::standard_rubric()));
    EXPECT_EQ(document["benchmark"].is_null(), compared == nullptr);
  }
}

}  // namespace
}  // namespace ream::session
