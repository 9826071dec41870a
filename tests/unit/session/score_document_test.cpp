#include "session/scoring/score_document.hpp"

#include <gtest/gtest.h>

#include <set>

#include "core/file.hpp"
#include "session/folder/session_folder.hpp"
#include "support/expect_error.hpp"
#include "support/json_schema.hpp"
#include "support/places.hpp"
#include "support/some_metrics.hpp"
#include "support/temporary_folder.hpp"

namespace ream::session {
namespace {

using nlohmann::json;

score::Rubric rubric() {
  return score::rubric_from_json(
      {{"name", "Simple"},
       {"version", 3},
       {"criteria",
        {{{"metric", "version_error_deg"}, {"band", {{"better", "less"}, {"pass", 1}, {"warn", 2}}}},
         {{"metric", "sparc"}, {"none", -5}, {"full", -2}}}}},
      "a test");
}

const json& metric(const json& score, const std::string& key) {
  for (const json& each : score.at("metrics"))
    if (each.at("metric") == key) return each;
  throw std::logic_error("no metric " + key);
}

TEST(ScoreDocument, FitsItsSchemaWithAndWithoutAStoredRubric) {
  const json schema = read_json_file(test::source_folder() + "/proto/score.schema.json");
  for (const char* id : {"", "simple"}) {
    const json document =
        score_document("ream", json::object(), test::some_metrics(1.5), {rubric(), id, nullptr});
    EXPECT_EQ(test::schema_faults(schema, document), std::vector<std::string>{});
    EXPECT_EQ(document.at("rubric_id").is_null(), *id == 0);
    EXPECT_EQ(document.at("theatre"), false);
    EXPECT_EQ(document.at("physics"), 1) << "of a session from before it was said";
  }
}

TEST(ScoreDocument, IsExplainedMetricByMetric) {
  const json score = explained_score(score_document("ream", {{"theatre", true}, {"physics", 7}},
                                                    test::some_metrics(1.5), {rubric(), "simple", nullptr}));
  EXPECT_EQ(score.at("physics"), 7);
  std::set<std::string> keys;
  for (const json& each : score.at("metrics")) keys.insert(each.at("metric").get<std::string>());
  EXPECT_EQ(keys.size(), score::metric_catalogue().size());
  const json& version = metric(score, "version_error_deg");
  EXPECT_EQ(version.at("band").at("warn"), 2) << "the rubric's limits, not the catalogue's";
  EXPECT_EQ(version.at("verdict"), "warn");
  EXPECT_EQ(version.at("points"), 50.0);
  const json& inclination = metric(score, "inclination_error_deg");
  EXPECT_TRUE(inclination.at("value").is_null());
  EXPECT_TRUE(inclination.at("verdict").is_null());
  EXPECT_TRUE(inclination.at("points").is_null()) << "the rubric does not ask for it";
  EXPECT_EQ(inclination.at("missing"), "no bone was removed");
  EXPECT_EQ(score.at("theatre"), true);
  EXPECT_EQ(score.at("said_percent"), 50.0);
}

TEST(ScoreDocument, ReadsScoresOfBuildsWithoutAnIdOfTheRubric) {
  json document = score_document("ream", json::object(), test::some_metrics(1.0), {rubric(), "x", nullptr});
  document.erase("rubric_id");
  EXPECT_TRUE(explained_score(document).at("rubric").at("id").is_null());
}

TEST(WriteResults, LosesNothingThatWasSaidBefore) {
  const test::TemporaryFolder folder;
  const auto document = [](const json& metrics) {
    return score_document("ream", json::object(), metrics, {rubric(), "simple", nullptr});
  };
  const json good = test::some_metrics(1.0);
  write_results(folder.path(), good, document(good));
  EXPECT_EQ(read_json_file(metrics_json(folder.path())), good);
  json poorer = good;
  poorer["contact_time_s"] = nullptr;
  poorer["missing"]["contact_time_s"] = "the case is gone";
  test::expect_error(ErrorKind::conflict, "contact_time_s",
                     [&] { write_results(folder.path(), poorer, document(poorer)); });
  EXPECT_EQ(read_json_file(metrics_json(folder.path())), good);
  EXPECT_EQ(read_json_file(score_json(folder.path())), document(good));
  json richer = good;
  richer["sparc"] = -3.0;
  write_results(folder.path(), richer, document(richer));
  EXPECT_EQ(read_json_file(metrics_json(folder.path())), richer);
  EXPECT_EQ(read_json_file(score_json(folder.path())), document(richer));
}

}  // namespace
}  // namespace ream::session
