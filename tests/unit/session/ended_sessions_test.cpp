#include "session/scoring/ended_sessions.hpp"

#include <gtest/gtest.h>

#include "core/data_folder.hpp"
#include "core/file.hpp"
#include "support/temporary_folder.hpp"

namespace ream::session {
namespace {

using nlohmann::json;

class EndedSessions : public testing::Test {
 protected:
  void keep(const std::string& id, const json& labels, const json& metrics = json()) {
    const auto folder = sessions_folder(data_.path()) / id;
    std::filesystem::create_directories(folder);
    json session = {{"id", id},
                    {"build", "ream 1"},
                    {"case", "demo"},
                    {"case_name", "Demo"},
                    {"side", "right"},
                    {"script", "demo"},
                    {"tool", "sphere 9"},
                    {"backend", "cpu"},
                    {"ticks", 1000},
                    {"device", "browser"},
                    {"device_profile", "ideal"},
                    {"force_scale", 1.0},
                    {"random_seed", 1},
                    {"state", "finished"},
                    {"start_grid_hash", "0123456789abcdef"}};
    session.update(labels);
    write_file_atomically(folder / "session.json", session.dump());
    write_file_atomically(
        folder / "timing.json",
        R"({"tick_us": {"mean":1,"p50":1,"p99":1,"p999":1,"max":1}, "missed": 0, "ticks": 1000})");
    if (!metrics.is_null()) write_file_atomically(folder / "metrics.json", metrics.dump());
  }

  std::vector<std::string> ids(const std::vector<EndedSession>& sessions) const {
    std::vector<std::string> result;
    for (const EndedSession& session : sessions) result.push_back(session.id);
    return result;
  }

  test::TemporaryFolder data_;
};

TEST_F(EndedSessions, AreToldOldestFirst) {
  keep("b", {{"created_utc", "2026-01-02T00:00:00Z"}});
  keep("c", {{"created_utc", "2026-01-01T00:00:00Z"}});
  keep("a", {{"created_utc", "2026-01-02T00:00:00Z"}});
  EXPECT_EQ(ids(ended_sessions(data_.path())), (std::vector<std::string>{"c", "a", "b"}));
  EXPECT_TRUE(ended_sessions(data_.path() / "nowhere").empty());
}

TEST_F(EndedSessions, OfATraineeAreFoundByUserCodeOrName) {
  keep("a", {{"trainee_id", "u-1"}, {"trainee", "Zoe"}});
  keep("b", {{"trainee_id", "u-1"}, {"participant", "P-1"}});
  keep("c", {{"trainee", "Zoe"}});
  keep("d", json::object());
  const auto all = ended_sessions(data_.path());
  EXPECT_EQ(ids(sessions_of_trainee(all, "u-1")), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(ids(sessions_of_trainee(all, "P-1")), std::vector<std::string>{"b"});
  EXPECT_EQ(ids(sessions_of_trainee(all, "Zoe")), (std::vector<std::string>{"a", "c"}));
  EXPECT_TRUE(sessions_of_trainee(all, "").empty()) << "nobody's sessions are nobody's";
  EXPECT_EQ(trainee_of({{"trainee_id", "u-1"}, {"trainee", "Zoe"}}), "u-1");
}

TEST_F(EndedSessions, LearnFromTheirMetrics) {
  keep("a", {{"created_utc", "2026-01-01T00:00:00Z"}, {"theatre", true}}, {{"duration_s", 100.0}});
  keep("b", {{"created_utc", "2026-01-02T00:00:00Z"}}, {{"duration_s", 900.0}});
  keep("c", {{"created_utc", "2026-01-03T00:00:00Z"}});
  keep("demo", {{"device", "script"}}, {{"duration_s", 60.0}});
  keep("untouched", json::object(), {{"duration_s", 60.0}, {"removed_volume_mm3", 0.0}});
  score::Rubric rubric;
  rubric.name = "fast";
  rubric.pass_points = 50.0;
  rubric.criteria.push_back({"duration_s", score::Ramp{600.0, 60.0}, std::nullopt, 1.0, false});
  const score::LearningCurve curve = learning_of(ended_sessions(data_.path()), rubric, {});
  ASSERT_EQ(curve.points.size(), 2u) << "one left no metrics, one is a script's, one cut nothing";
  EXPECT_TRUE(curve.points[0].theatre);
  EXPECT_EQ(curve.points[0].outcome, score::Outcome::pass);
  EXPECT_EQ(curve.points[1].outcome, score::Outcome::fail);
}

}  // namespace
}  // namespace ream::session
