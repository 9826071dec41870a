#include <cmath>

#include "score_fixture.hpp"

namespace ream::test {
namespace {

/// What scores over REST mean, beyond their form.
class ScoresTest : public ScoreTest {
 protected:
  const json& metric(const json& score, const std::string& key) {
    for (const json& each : score.at("metrics"))
      if (each.at("metric") == key) return each;
    throw std::logic_error("no metric " + key);
  }
};

TEST_F(ScoresTest, TellEveryMetricWithWhatItMeansAndWhyItIsNotSaid) {
  put_session("good", 2.0, 1, {{"theatre", true}});
  start();
  add_simple_rubric();
  const json score = told(all + "/good/score?rubric=simple");
  EXPECT_EQ(score.at("metrics").size(), score::metric_catalogue().size());
  for (const json& each : score.at("metrics")) {
    for (const char* words : {"definition", "source", "confidence", "name"})
      EXPECT_FALSE(each.at(words).get<std::string>().empty()) << each;
    EXPECT_NE(each.at("value").is_null(), each.at("missing").is_null()) << each;
  }
  EXPECT_EQ(metric(score, "version_error_deg").at("value"), 2.0);
  EXPECT_EQ(metric(score, "version_error_deg").at("unit"), "deg");
  EXPECT_EQ(metric(score, "version_error_deg").at("points"), 80.0);
  EXPECT_EQ(metric(score, "sparc").at("missing"), "no bone was removed");
  EXPECT_EQ(score.at("points"), 80.0);
  EXPECT_EQ(score.at("outcome"), "pass");
  EXPECT_EQ(score.at("theatre"), true);
  EXPECT_EQ(score.at("standing"), "computed");
  EXPECT_EQ(score.at("rubric").at("id"), "simple");
  EXPECT_EQ(score.at("rubric").at("version"), 1);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "sessions/good/score.json")) << "asking keeps nothing";
}

TEST_F(ScoresTest, AreKeptWithTheRubricAsItWas) {
  put_session("good", 2.0, 1);
  start();
  add_simple_rubric();
  EXPECT_EQ(post(all + "/good/score", R"({"rubric": "simple"})").status, 200);
  json edited = simple_rubric(1);
  edited["pass_points"] = 90;
  EXPECT_EQ(put(rubrics + "/simple", edited.dump()).status, 200);
  const json before = told(all + "/good/score");
  EXPECT_EQ(before.at("standing"), "kept");
  EXPECT_EQ(before.at("outcome"), "pass");
  EXPECT_EQ(before.at("rubric").at("version"), 1);
  EXPECT_EQ(before.at("rubric").at("rubric").at("pass_points"), 50);
  EXPECT_EQ(told(all + "/good/score?rubric=simple").at("outcome"), "fail");
  EXPECT_EQ(told(all + "/good").at("score"),
            (json{{"points", 80.0}, {"outcome", "pass"}, {"rubric", "Simple"}, {"version", 1}}));
  const json schema = read_json_file(source_folder() + "/proto/score.schema.json");
  EXPECT_TRUE(schema_faults(schema, kept("good", "score.json")).empty());
}

TEST_F(ScoresTest, ByARubricThatIsNotSavedAreAsIfItWereAndNothingIsKept) {
  put_session("good", 2.0, 1);
  start();
  add_simple_rubric();
  const json before = told(rubrics);
  const HttpReply reply = post(all + "/good/score/preview", simple_rubric(1).dump());
  ASSERT_EQ(reply.status, 200) << reply.body;
  json preview = json::parse(reply.body), saved = told(all + "/good/score?rubric=simple");
  EXPECT_EQ(preview.at("rubric").at("id"), nullptr);
  preview["rubric"].erase("id");
  saved["rubric"].erase("id");
  EXPECT_EQ(preview, saved);
  json strict = simple_rubric(1);
  strict["pass_points"] = 90;
  EXPECT_EQ(json::parse(post(all + "/good/score/preview", strict.dump()).body).at("outcome"), "fail");
  EXPECT_EQ(told(rubrics), before);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "sessions/good/score.json"));
}

TEST_F(ScoresTest, RestOnMetricsThatARubricMayAskFor) {
  start();
  const json metrics = told("/api/v1/metrics").at("metrics");
  ASSERT_EQ(metrics.size(), score::metric_catalogue().size());
  json every = simple_rubric(1);
  every["criteria"] = json::array();
  for (const json& metric : metrics)
    every["criteria"].push_back({{"metric", metric.at("metric")}, {"none", 1}, {"full", 0}});
  EXPECT_EQ(post(rubrics, json{{"id", "every"}, {"rubric", every}}.dump()).status, 201);
}

TEST_F(ScoresTest, AnUnusableRubricIsRefusedWithThePlaceAtFault) {
  put_session("good", 2.0, 1);
  start();
  json odd = simple_rubric(1);
  odd["criteria"].push_back({{"metric", "elegance"}, {"none", 0}, {"full", 1}});
  const HttpReply reply = post(all + "/good/score/preview", odd.dump());
  EXPECT_EQ(reply.status, 422);
  EXPECT_EQ(json::parse(reply.body).at("errors").at(0).at("pointer"), "#/criteria/1/metric");
}

TEST_F(ScoresTest, OfARunningSessionAreThoseSoFar) {
  start();
  const HttpReply made = post(all, R"({"case": "planned", "script": "demo", "theatre": true})");
  ASSERT_EQ(made.status, 201) << made.body;
  const std::string path = all + "/" + json::parse(made.body).at("id").get<std::string>();
  EXPECT_EQ(told(path + "/score").at("theatre"), true) << "before the start, too";
  ASSERT_EQ(post(path + "/start").status, 200);
  const json score = told(path + "/score");
  EXPECT_EQ(score.at("standing"), "live");
  EXPECT_EQ(metric(score, "axial_thrust_mean_n").at("value"), 40.0);
  EXPECT_EQ(score.at("outcome"), "undecided");
}

TEST_F(ScoresTest, SortAndFilterTheListOfSessions) {
  for (int i = 0; i < 4; ++i) put_session("s" + std::to_string(i), 2.0 * i, 4 - i);
  start();
  add_simple_rubric();
  for (int i = 0; i < 3; ++i)
    EXPECT_EQ(post(all + "/s" + std::to_string(i) + "/score", R"({"rubric": "simple"})").status, 200);
  const auto ids = [this](const std::string& query) {
    const json list = told(all + "?" + query);
    std::string found;
    for (const json& each : list.at("sessions")) found += each.at("id").get<std::string>();
    return found;
  };
  EXPECT_EQ(ids("sort=-points"), "s0s1s2s3") << "without points last";
  EXPECT_EQ(ids("sort=points"), "s3s2s1s0");
  EXPECT_EQ(ids("outcome=pass&sort=points"), "s2s1s0");
  EXPECT_EQ(ids("outcome=none"), "s3");
  EXPECT_EQ(ids("points_from=80&sort=-points"), "s0s1");
  EXPECT_EQ(ids("points_to=80&sort=-points"), "s1s2");
}

TEST_F(ScoresTest, TwoWhoEditARubricAtOnceDoNotOverwriteOneAnother) {
  start();
  add_simple_rubric();
  const std::string path = rubrics + "/simple", tag = get(path).headers.at("etag");
  json mine = simple_rubric(1), theirs = simple_rubric(1);
  mine["pass_points"] = 60;
  theirs["pass_points"] = 70;
  EXPECT_EQ(put(path, mine.dump(), tag).status, 200);
  EXPECT_EQ(put(path, theirs.dump(), tag).status, 412);
  EXPECT_EQ(put(path, theirs.dump()).status, 409);
  const json now = told(path);
  EXPECT_EQ(now.at("versions"), json::array({1, 2}));
  EXPECT_EQ(now.at("rubric").at("pass_points"), 60);
  EXPECT_EQ(told(path + "?version=1").at("rubric").at("pass_points"), 50) << "versions never change";
  json same = now.at("rubric");
  EXPECT_EQ(put(path, same.dump()).status, 200);
  EXPECT_EQ(told(path).at("version"), 2) << "what says the same is no new version";
}

TEST_F(ScoresTest, AreComputedAnewForManyByAJob) {
  for (const char* id : {"one", "two", "poorer"}) put_session(id, 3.0, 1);
  put_session("lost", 3.0, 1);
  std::filesystem::remove(folder.path() / "sessions/lost/recording.ream");
  const json before = kept("poorer", "metrics.json");
  start();
  add_simple_rubric();
  const json done = ended(post(rescorings, R"({"filter": {"case": "planned"}, "rubric": "simple"})"));
  ASSERT_EQ(done.at("state"), "done") << done;
  const json report = told("/api/v1/jobs/" + done.at("id").get<std::string>() + "/result");
  EXPECT_EQ(report.at("scored").size(), 2u);
  EXPECT_EQ(report.at("failed").size(), 2u);
  EXPECT_EQ(kept("one", "metrics.json").at("duration_s"), 6.0);
  EXPECT_EQ(kept("one", "score.json").at("score").at("points"), 70.0);
  EXPECT_EQ(kept("poorer", "metrics.json"), before) << "what would say less is left as it was";
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "sessions/poorer/score.json"));
}

TEST_F(ScoresTest, ComputedAnewTellHowFarTheyAreAndCanBeCancelled) {
  for (int i = 0; i < 100; ++i) put_session("s" + std::to_string(i), 3.0, 1);
  hold();
  start();
  const std::string id = json::parse(post(rescorings, R"({"filter": {}})").body).at("id");
  while (job(id).at("state") == "waiting") std::this_thread::yield();
  while (job(id).at("share") == 0.0) std::this_thread::yield();
  EXPECT_EQ(job(id).at("step"), "session 1 of 100");
  EXPECT_LT(job(id).at("share"), 0.01);
  http_request(server->port(), "DELETE", "/api/v1/jobs/" + id);
  release();
  while (job(id).at("state") == "running") std::this_thread::yield();
  EXPECT_EQ(job(id).at("state"), "cancelled");
  EXPECT_EQ(told(all + "?outcome=none&limit=1").at("total"), 100) << "none was done";
}

TEST_F(ScoresTest, TellACourseOfLearningInOrderOfTime) {
  const double errors[] = {8.0, 7.0, 2.0, 1.0};
  for (int i = 0; i < 4; ++i) put_session("s" + std::to_string(3 - i), errors[i], 1 + i);
  put_session("other", 9.0, 9, {{"trainee_id", "otto"}});
  put_session("demo", 0.5, 8, {{"device", "script"}});
  start();
  add_simple_rubric();
  const HttpReply made = post(benchmarks, R"({"name": "Ours", "experts": ["s0", "s1"]})");
  ASSERT_EQ(made.status, 201) << made.body;
  const std::string id = json::parse(made.body).at("id");
  const json curve = told(learning + "?trainee=tina&rubric=simple&benchmark=" + id);
  std::string outcomes;
  for (const json& each : curve.at("sessions"))
    outcomes += each.at("session").get<std::string>() + " " + each.at("outcome").get<std::string>() + " ";
  EXPECT_EQ(outcomes, "s3 fail s2 fail s1 pass s0 pass ");
  // P = ln 2, Q = ln(0.8 / 0.6), s = Q / (P + Q)
  const double s = std::log(0.8 / 0.6) / (std::log(2.0) + std::log(0.8 / 0.6));
  EXPECT_NEAR(curve.at("sessions").at(3).at("cusum").get<double>(), 2.0 * (1.0 - s) - 2.0 * s, 1e-12);
  const json& reached = curve.at("benchmark");
  EXPECT_EQ(reached.at("proficient"), true) << "an error of 1 is below the experts' mean of 1.5";
  EXPECT_EQ(reached.at("first_proficient"), "s0");
}

TEST_F(ScoresTest, WithoutUsersTellACourseOfLearningByName) {
  const json ann = {{"trainee", "Ann"}, {"trainee_id", nullptr}};
  put_session("s0", 3.0, 1, ann);
  put_session("s1", 2.0, 2, ann);
  put_session("annie", 2.0, 3, {{"trainee", "Annie"}, {"trainee_id", nullptr}});
  put_session("user", 2.0, 4, {{"trainee", "Ann"}});
  put_session("study", 2.0, 5,
              {{"trainee", "Ann"}, {"trainee_id", nullptr}, {"participant", "K7-F3M"}, {"study", "s"}});
  start();
  const json curve = told(learning + "?name=Ann");
  std::string sessions;
  for (const json& each : curve.at("sessions")) sessions += each.at("session").get<std::string>() + " ";
  EXPECT_EQ(sessions, "s0 s1 ");
}

TEST_F(ScoresTest, OfExpertsAndNovicesGiveAMark) {
  const double novices[] = {6.0, 7.0, 8.0}, experts[] = {1.0, 2.0, 3.0};
  for (int i = 0; i < 3; ++i) {
    put_session("n" + std::to_string(i), novices[i], 1);
    put_session("e" + std::to_string(i), experts[i], 1);
  }
  start();
  add_simple_rubric();
  const json made = json::parse(post(benchmarks, R"({"name": "Ours", "experts": ["e0", "e1", "e2"],
      "novices": ["n0", "n1", "n2"], "rubric": "simple"})")
                                    .body);
  const json& points = made.at("cuts").at(0);
  EXPECT_EQ(points.at("of"), "points");
  EXPECT_NEAR(points.at("cut").get<double>(), 55.0, 1e-9) << "half way between groups of equal spread";
  EXPECT_EQ(points.at("experts_failing"), 0);
  EXPECT_EQ(made.at("rubric"), "simple@1");
  const auto file =
      score::load_benchmark(folder.path() / "benchmarks" / (made.at("id").get<std::string>() + ".json"));
  EXPECT_EQ(file.name, "Ours") << "as ream score --benchmark takes it";
}

TEST_F(ScoresTest, DeviationsAreOneByteAVertexWithTheirScale) {
  put_session("good", 2.0, 1);
  start();
  const std::string path = all + "/good/deviation?to=plan";
  EXPECT_EQ(ended(get(path)).at("state"), "done");
  const HttpReply reply = get(path);
  EXPECT_EQ(reply.status, 200);
  EXPECT_EQ(reply.body, std::string("\x80\xff\x00\x7f", 4));
  EXPECT_EQ(reply.headers.at("deviation-vertices"), "4");
  EXPECT_EQ(reply.headers.at("deviation-step-mm"), "0.03125");
  EXPECT_EQ(reply.headers.at("deviation-unknown"), "-128");
}

TEST_F(ScoresTest, TableIsForStatistics) {
  put_session("a", 2.0, 1, {{"trainee", "Zoe"}});
  put_session("b", 4.0, 2, {{"participant", "K7-F3M"}, {"study", "pilot"}});
  start();
  add_simple_rubric();
  const std::string csv = get(scores + "?format=csv&rubric=simple").body;
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 3);
  EXPECT_EQ(csv.find("Zoe"), std::string::npos);
  const json rows = told(scores + "?rubric=simple&participant=K7-F3M").at("scores");
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].at("trainee"), "K7-F3M");
  EXPECT_EQ(rows[0].at("points"), 60.0);
  EXPECT_TRUE(rows[0].at("sparc").is_null());
}

}  // namespace
}  // namespace ream::test
