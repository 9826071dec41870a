#include <future>

#include "score/rubric.hpp"
#include "score_fixture.hpp"

namespace ream::test {
namespace {

class ScoreContractTest : public ScoreTest {
 protected:
  ScoreContractTest() {
    for (int i = 0; i < 6; ++i) put_session("s" + std::to_string(i), 1.0 + i, 1 + i);
    folder.write("sessions/bare/session.json", R"({"case": "planned", "script": "demo"})");
  }

  void refused_bodies(const std::string& method, const std::string& pattern, const std::string& path,
                      const std::string& good, const std::string& unusable) {
    expect_request(method, pattern, path, 400, "{");
    expect_request(method, pattern, path, 403, good, foreign);
    expect_request(method, pattern, path, 413, std::string(options.listen.limits.body_bytes + 1, ' '));
    expect_request(method, pattern, path, 415, good, {{"Content-Type", "text/plain"}});
    expect_request(method, pattern, path, 422, unusable);
  }

  void rubrics_of_all_kinds() {
    const json wanted = {{"id", "simple"}, {"rubric", simple_rubric(1)}};
    json odd = wanted;
    odd["rubric"]["criteria"][0]["metric"] = "elegance";
    refused_bodies("POST", rubrics, rubrics, wanted.dump(), R"({"id": "simple"})");
    expect_post(rubrics, rubrics, 422, odd.dump());
    expect_post(rubrics, rubrics, 201, wanted.dump());
    expect_post(rubrics, rubrics, 409, wanted.dump());
    expect_get(rubrics, rubrics, 200);
    const std::string metrics = "/api/v1/metrics";
    expect_get(metrics, metrics, 200);
    const std::string path = rubrics + "/simple", first = simple_rubric(1).dump();
    refused_bodies("PUT", one_rubric, path, first, "{}");
    json edited = simple_rubric(1);
    edited["pass_points"] = 60;
    expect_request("PUT", one_rubric, path, 200, edited.dump());
    expect_request("PUT", one_rubric, path, 409, first);
    expect_request("PUT", one_rubric, path, 412, edited.dump(), {{"If-Match", "\"0123456789abcdef\""}});
    expect_request("PUT", one_rubric, rubrics + "/nothing", 404, first);
    expect_get(one_rubric, path, 200);
    expect_get(one_rubric, path + "?version=1", 200);
    expect_get(one_rubric, path + "?version=3", 404);
    expect_get(one_rubric, path + "?version=0", 422);
    expect_get(one_rubric, rubrics + "/nothing", 404);
  }

  void benchmarks_of_all_kinds() {
    const std::string good = R"({"name": "Ours", "experts": ["s0", "s1", "s2"], "novices": ["s3", "s4", "s5"],
                                 "rubric": "simple@1", "density": "kernel"})";
    refused_bodies("POST", benchmarks, benchmarks, good, R"({"name": "Ours", "experts": []})");
    expect_post(benchmarks, benchmarks, 404, R"({"name": "O", "experts": ["s0"], "rubric": "nothing"})");
    expect_post(benchmarks, benchmarks, 422, R"({"name": "O", "experts": ["s0", "bare"]})");
    expect_post(benchmarks, benchmarks, 422, R"({"name": "O", "experts": ["s0", "nobody"]})");
    expect_post(benchmarks, benchmarks, 422,
                R"({"name": "O", "experts": ["s0"], "novices": ["s3", "s4", "s5"]})");
    const HttpReply reply = post(benchmarks, good);
    expect_as_described("POST", benchmarks, 201, reply);
    benchmark = json::parse(reply.body).at("id");
    expect_post(benchmarks, benchmarks, 201, R"({"name": "Two", "experts": ["s0", "s1"]})");
    expect_get(benchmarks, benchmarks, 200);
    expect_get(one_benchmark, benchmarks + "/" + benchmark, 200);
    expect_get(one_benchmark, benchmarks + "/nothing", 404);
    folder.write("benchmarks/damaged.json", "{");
    expect_get(one_benchmark, benchmarks + "/damaged", 422);
    expect_get(benchmarks, benchmarks, 200);
  }

  void scores_of_sessions() {
    const std::string pattern = one + "/score", path = all + "/s0/score", live = all + "/" + create();
    expect_get(pattern, path, 200);
    expect_get(pattern, path + "?rubric=simple@1&benchmark=" + benchmark, 200);
    expect_get(pattern, path + "?rubric=nothing", 404);
    expect_get(pattern, path + "?rubric=simple@x", 422);
    expect_get(pattern, all + "/nobody/score", 404);
    expect_get(pattern, all + "/bare/score", 404);
    expect_get(pattern, live + "/score", 200);
    const std::string good = R"({"rubric": "simple"})";
    refused_bodies("POST", pattern, path, good, R"({"rubric": "Simple"})");
    expect_post(pattern, path, 200, good);
    expect_post(pattern, path, 200, "{}");
    expect_post(pattern, path, 404, R"({"rubric": "simple@7"})");
    expect_post(pattern, all + "/nobody/score", 404, "{}");
    expect_post(pattern, live + "/score", 409, "{}");
    expect_get(pattern, path, 200);
    const std::string preview = pattern + "/preview", rubric = simple_rubric(1).dump();
    json odd = simple_rubric(1);
    odd["criteria"][0]["metric"] = "elegance";
    refused_bodies("POST", preview, path + "/preview", rubric, "{}");
    expect_post(preview, path + "/preview", 422, odd.dump());
    expect_post(preview, path + "/preview", 200, rubric);
    expect_post(preview, live + "/score/preview", 200, rubric);
    expect_post(preview, all + "/nobody/score/preview", 404, rubric);
    expect_post(preview, all + "/bare/score/preview", 404, rubric);
    expect_get(all, all + "?sort=-points&outcome=undecided,none", 200);
    expect_get(scores, scores, 200);
    expect_get(scores, scores + "?format=csv&rubric=simple", 200);
    expect_get(scores, scores + "?format=csv&table=codebook", 200);
    expect_get(scores, scores + "?rubric=nothing", 404);
    expect_get(scores, scores + "?points_from=101", 422);
  }

  void learning_of_all_kinds() {
    expect_get(learning, learning + "?trainee=tina&rubric=simple&benchmark=" + benchmark, 200);
    expect_get(learning, learning + "?participant=K7-F3M", 200);
    expect_get(learning, learning, 422);
    expect_get(learning, learning + "?name=Tina", 200);
    expect_get(learning, learning + "?trainee=tina&participant=K7-F3M", 422);
    expect_get(learning, learning + "?trainee=tina&name=Tina", 422);
    expect_get(learning, learning + "?trainee=tina&acceptable_rate=0.5", 422);
    expect_get(learning, learning + "?trainee=tina&benchmark=nothing", 404);
  }

  void deviations() {
    const std::string pattern = one + "/deviation", path = all + "/s0/deviation";
    expect_get(pattern, path, 400);
    expect_get(pattern, path + "?to=moon", 422);
    expect_get(pattern, all + "/bare/deviation?to=plan", 404);
    expect_get(pattern, all + "/" + create() + "/deviation?to=plan", 409);
    hold();
    const HttpReply first = get(path + "?to=plan"), second = get(path + "?to=implant");
    expect_as_described("GET", pattern, 202, first);
    EXPECT_EQ(json::parse(first.body).at("id"), json::parse(second.body).at("id")) << "made once";
    release();
    EXPECT_EQ(ended(first).at("state"), "done");
    expect_get(pattern, path + "?to=plan", 200);
    expect_get(pattern, path + "?to=implant", 404);
  }

  void rescoring() {
    const std::string good = R"({"sessions": ["s0", "s1"], "rubric": "simple"})";
    refused_bodies("POST", rescorings, rescorings, good, R"({"rubric": "simple"})");
    expect_post(rescorings, rescorings, 422, R"({"sessions": ["s0"], "filter": {}})");
    expect_post(rescorings, rescorings, 422, R"({"filter": {"case": "nothing"}})");
    expect_post(rescorings, rescorings, 404, R"({"sessions": ["nobody"]})");
    expect_post(rescorings, rescorings, 404, R"({"filter": {}, "rubric": "nothing"})");
    expect_post(rescorings, rescorings, 409, json{{"sessions", {create()}}}.dump());
    const json done = ended(expect_repeatable(rescorings, rescorings, 202, good));
    EXPECT_EQ(done.at("kind"), "rescoring");
    expect_get(one_job + "/result", "/api/v1/jobs/" + done.at("id").get<std::string>() + "/result", 200);
  }

  /// While there is too much to do, or somebody waits for other work already.
  void too_much() {
    put_session("s9", 1.0, 9);
    hold();
    int status = 202;
    while (status == 202) status = post(rescorings, R"({"sessions": ["s0"]})").status;
    expect_post(rescorings, rescorings, 503, R"({"sessions": ["s0"]})");
    expect_get(one + "/deviation", all + "/s9/deviation?to=plan", 503);
    release();
    server->stop();
    options.data_folder.clear();
    start();
    const json wanted = {{"id", "other"}, {"rubric", simple_rubric(1)}};
    expect_post(rubrics, rubrics, 503, wanted.dump());
    expect_request("PUT", one_rubric, rubrics + "/standard", 503,
                   simple_rubric(score::standard_rubric().version).dump());
    expect_post(benchmarks, benchmarks, 503, R"({"name": "Two", "experts": ["s0", "s1"]})");
  }

  std::string benchmark;
};

TEST_F(ScoreContractTest, EveryDescribedReplyIsGivenAsDescribed) {
  start();
  rubrics_of_all_kinds();
  benchmarks_of_all_kinds();
  scores_of_sessions();
  learning_of_all_kinds();
  deviations();
  rescoring();
  too_much();
  // Of a table or a curve while others wait for work of that kind, and of the index while the database is
  // away: LowPriorityExecutor's and SessionRegister's tests.
  expect_all_given({"scores"}, {{"GET " + scores, 503}, {"GET " + learning, 503}});
}

TEST_F(ScoreContractTest, TakesExactlyTheRubricsThatTheSchemaTakes) {
  start();
  const json& schema = contract.at("components").at("schemas").at("Rubric");
  int next = 0;
  for (
      const char* text :
      {R"({"name": "A", "version": 1, "criteria": [{"metric": "sparc", "none": -5, "full": -2}]})",
       R"({"name": "A", "version": 1, "criteria": [{"metric": "passes", "band": {"better": "less", "pass": 3, "warn": 5}}]})",
       R"({"name": "", "version": 1, "criteria": [{"metric": "sparc", "none": -5, "full": -2}]})",
       R"({"name": "A", "criteria": [{"metric": "sparc", "none": -5, "full": -2}]})",
       R"({"name": "A", "version": 0, "criteria": [{"metric": "sparc", "none": -5, "full": -2}]})",
       R"({"name": "A", "version": 1, "criteria": []})", R"({"name": "A", "version": 1})",
       R"({"name": "A", "version": 1, "pass_points": 101, "criteria": [{"metric": "version_error_deg"}]})",
       R"({"name": "A", "version": 1, "pass_points": 70, "criteria": [{"metric": "version_error_deg", "weight": -1}]})",
       R"({"name": "A", "version": 1, "mark": 70, "criteria": [{"metric": "version_error_deg"}]})",
       R"({"name": "A", "version": 1, "criteria": [{"metric": "version_error_deg", "critical": true}]})"}) {
    const json wanted = {{"id", "r" + std::to_string(next++)}, {"rubric", json::parse(text)}};
    const bool fits = faults(schema, wanted.at("rubric")).empty();
    const HttpReply reply = post(rubrics, wanted.dump());
    EXPECT_EQ(reply.status, fits ? 201 : 422) << text << reply.body;
    EXPECT_TRUE(fits || !json::parse(reply.body).at("detail").get<std::string>().empty()) << text;
  }
  for (
      const char* text :
      {R"({"name": "A", "version": 1, "criteria": [{"metric": "sparc"}]})",
       R"({"name": "A", "version": 1, "criteria": [{"metric": "sparc", "none": 1, "full": 1}]})",
       R"({"name": "A", "version": 1, "criteria": [{"metric": "elegance", "none": 0, "full": 1}]})",
       R"({"name": "A", "version": 1, "criteria": [{"metric": "version_error_deg"}, {"metric": "version_error_deg"}]})"}) {
    const json wanted = {{"id", "r" + std::to_string(next++)}, {"rubric", json::parse(text)}};
    EXPECT_EQ(post(rubrics, wanted.dump()).status, 422) << "fits the schema, but makes no sense: " << text;
  }
}

}  // namespace
}  // namespace ream::test
