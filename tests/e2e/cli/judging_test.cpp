#include <algorithm>

#include "core/file.hpp"
#include "e2e/cli/command_line.hpp"

namespace ream::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// What becomes of sessions once they are over: judged, compared, put into tables.
class Judging : public CommandLine {
 protected:
  void SetUp() override { simulate_short_demo(); }

  /// A copy of the run as a session of the data folder.
  void keep(const std::string& id, const json& labels) {
    const fs::path to = folder() / "data/sessions" / id;
    fs::create_directories(to.parent_path());
    fs::copy(folder() / "run", to, fs::copy_options::recursive);
    json session = json_of("run/session.json");
    session["id"] = id;
    session["state"] = "finished";
    session["device"] = "browser";
    session.update(labels);
    write_file_atomically(to / "session.json", session.dump());
  }

  /// A rubric that this run passes or fails.
  std::string rubric(const std::string& name, double pass_points) {
    write(name, json{{"name", name},
                     {"version", 1},
                     {"pass_points", pass_points},
                     {"criteria", {{{"metric", "duration_s"}, {"none", 100}, {"full", 0}}}}}
                    .dump());
    return name;
  }
};

TEST_F(Judging, ARunLeavesItsScoreWithTheRubric) {
  const json kept = json_of("run/score.json");
  EXPECT_EQ(kept.at("metrics"), json_of("run/metrics.json"));
  EXPECT_EQ(kept.at("score").at("rubric"), "Standard");
  EXPECT_EQ(kept.at("rubric").at("version"), kept.at("score").at("version"));
  EXPECT_EQ(kept.at("theatre"), false);
}

TEST_F(Judging, ScoreSavesWhatItSays) {
  const json told = answer({"score", "run", "--rubric", rubric("strict.json", 99.0), "--save"});
  EXPECT_EQ(told.at("score").at("outcome"), "fail");
  const json kept = json_of("run/score.json");
  EXPECT_EQ(kept.at("score"), told.at("score"));
  EXPECT_EQ(kept.at("rubric").at("name"), "strict.json");
  const std::string words = succeed({"score", "run"}).out;
  EXPECT_NE(words.find("Standard, version 2; theatre mode off"), std::string::npos) << words;
}

TEST_F(Judging, TheNewestRubricOfTheDataFolderHolds) {
  fs::create_directories(folder() / "data/rubrics/standard");
  json mine = json_of("run/score.json").at("rubric");
  mine["version"] = 3;
  mine["name"] = "House";
  write_file_atomically(folder() / "data/rubrics/standard/3.json", mine.dump());
  EXPECT_EQ(answer({"score", "run"}).at("score").at("rubric"), "House");
  EXPECT_EQ(answer({"score", "run", "--rubric", "standard@1"}).at("score").at("rubric"), "Standard");
  refuse(1, "no version 4", {"score", "run", "--rubric", "standard@4"});
}

TEST_F(Judging, ManySessionsBecomeATableWithItsCodebook) {
  keep("a", {{"created_utc", "2026-01-01T00:00:00Z"}, {"participant", "P-1"}, {"theatre", true}});
  keep("b", {{"created_utc", "2026-01-02T00:00:00Z"}, {"trainee", "Zo\u00eb"}});
  succeed({"score", "--all", "--csv", "scores.csv"});
  const std::string table = text_of("scores.csv"), book = text_of("scores-codebook.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 3);
  EXPECT_TRUE(table.starts_with("session,trainee,"));
  EXPECT_NE(table.find("removed_volume_mm3"), std::string::npos);
  EXPECT_NE(table.find("\na,P-1,"), std::string::npos);
  EXPECT_EQ(table.find("Zo\u00eb"), std::string::npos) << "no names";
  const std::string heads = table.substr(0, table.find('\r'));
  EXPECT_EQ(std::count(book.begin(), book.end(), '\n'), 2 + std::count(heads.begin(), heads.end(), ','));
  EXPECT_EQ(answer({"score", "--all"}).size(), 2u);
}

TEST_F(Judging, ATraineesSessionsAreACourseOfLearning) {
  for (int i = 1; i <= 3; ++i)
    keep("s" + std::to_string(i),
         {{"trainee_id", "u-1"}, {"created_utc", "2026-01-0" + std::to_string(i) + "T00:00:00Z"}});
  const json told = answer({"score", "--trainee", "u-1", "--rubric", rubric("easy.json", 50.0)});
  EXPECT_EQ(told.at("sessions").size(), 3u);
  EXPECT_EQ(told.at("learning").at("standing"), "going on");
  EXPECT_EQ(told.at("learning").at("passes_to_go"), 5);
  EXPECT_EQ(told.at("learning").at("sessions").at(0).at("session"), "s1");
  const json strict =
      answer({"score", "--trainee", "u-1", "--rubric", "easy.json", "--alpha", "0.4", "--beta", "0.4"});
  EXPECT_EQ(strict.at("learning").at("standing"), "proficient") << "a coarser test needs fewer";
  refuse(1, "nobody", {"score", "--trainee", "nobody"});
  refuse(2, "one of these", {"score", "run", "--all"});
  refuse(1, "failure rate", {"score", "--trainee", "u-1", "--acceptable-rate", "0.7"});
}

TEST_F(Judging, ExpertsMakeABenchmarkThatOthersAreComparedWith) {
  const json made =
      answer({"benchmark", "run", "run", "--name", "house", "--out", "house.json", "--novices", "run"});
  EXPECT_EQ(made.at("benchmark"), json_of("house.json"));
  EXPECT_EQ(made.at("benchmark").at("name"), "house");
  EXPECT_NE(made.at("cuts").at(0).at("error").get<std::string>().find("1 novices"), std::string::npos);
  const json told = answer({"score", "run", "--benchmark", "house.json"}).at("benchmark");
  EXPECT_EQ(told.at("reached"), told.at("of")) << "whoever is the benchmark reaches it";
  refuse(1, "nobody", {"benchmark", "nobody"});
}

}  // namespace
}  // namespace ream::test
