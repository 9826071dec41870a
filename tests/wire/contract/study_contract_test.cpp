#include "access_fixture.hpp"

namespace ream::test {
namespace {

using access::Role;

/// A server with a person of every role.
class StudyContractTest : public AccessTest {
 protected:
  void SetUp() override {
    start();
    anna = token_of(add_user("anna", Role::operator_));
    ines_id = add_user("ines", Role::instructor);
    ines = token_of(ines_id);
    ivo_id = add_user("ivo", Role::instructor);
    ivo = token_of(ivo_id);
    tom_id = add_user("tom", Role::trainee);
    tom = token_of(tom_id);
    ben = token_of(add_user("ben", Role::trainee));
  }

  /// `path`: below the studies, with the ids in it.
  void expect(const std::string& method, const std::string& pattern, const std::string& path, int status,
              const Sent& sent = {}, const std::string& body = {}) {
    expect_request(method, pattern, path, status, body, sent);
  }
  void refused_bodies(const std::string& method, const std::string& pattern, const std::string& path,
                      const Sent& sent, const std::string& good, const std::string& unusable) {
    expect(method, pattern, path, 400, sent, "{");
    expect(method, pattern, path, 401, {}, good);
    expect(method, pattern, path, 403, with(sent, "Origin", "http://elsewhere.example"), good);
    expect(method, pattern, path, 413, sent, std::string(options.listen.limits.body_bytes + 1, ' '));
    expect(method, pattern, path, 415, with(sent, "Content-Type", "text/plain"), good);
    expect(method, pattern, path, 422, sent, unusable);
  }

  json made(const Sent& sent, const std::string& path, const std::string& body) {
    const HttpReply reply = request("POST", path, sent, body);
    EXPECT_EQ(reply.status, 201) << reply.body;
    return json::parse(reply.body);
  }
  static json all_answers() {
    json answers = json::object();
    for (const auto& item : study::face_validity_questionnaire().items)
      if (item.required) answers[item.id] = 3;
    return answers;
  }

  void making() {
    expect("GET", studies, studies, 200, tom);
    expect("GET", studies, studies, 401);
    expect("GET", studies, studies, 403, viewer());
    refused_bodies("POST", studies, studies, ines, wanted, R"({"name": "First year", "cases": []})");
    expect("POST", studies, studies, 422, ines, R"({"name": "First year"})");
    expect("POST", studies, studies, 403, tom, wanted);
    expect("POST", studies, studies, 404, ines, R"({"name": "First year", "cases": ["nowhere"]})");
    expect("POST", studies, studies, 201, ines, wanted);
    const json own = made(ines, studies, wanted);
    id = own.at("id");
    join_code = own.at("join_code");
    at = studies + "/" + id;
    expect("GET", studies, studies, 200, ines);
    expect("GET", one_study, at, 200, ines);
    expect("GET", one_study, at, 401);
    expect("GET", one_study, at, 403, viewer());
    expect("GET", one_study, at, 404, tom);
    expect("GET", one_study, studies + "/nothing", 404, ines);
  }

  void changing() {
    refused_bodies("PUT", one_study, at, ines, wanted, R"({"name": ""})");
    expect("PUT", one_study, at, 403, tom, wanted);
    expect("PUT", one_study, studies + "/nothing", 404, ines, wanted);
    expect("PUT", one_study, at, 404, ines, R"({"name": "First year", "cases": ["nowhere"]})");
    expect("PUT", one_study, at, 200, ines, wanted);
  }

  void taking_part() {
    const std::string path = studies + "/join";
    const std::string good = json{{"join_code", join_code}, {"experience", "novice"}}.dump();
    refused_bodies("POST", path, path, tom, good, json{{"join_code", join_code}}.dump());
    expect("POST", path, path, 403, viewer(), good);
    expect("POST", path, path, 404, tom, R"({"join_code": "nothing", "experience": "expert"})");
    const HttpReply reply = request("POST", path, tom, good);
    expect_as_described("POST", path, 201, reply);
    code = json::parse(reply.body).at("code");
    expect("POST", path, path, 409, tom, good);
    const std::string pattern = one_study + "/participants", here = at + "/participants";
    const std::string guest = R"({"experience": "expert", "procedures_done": 120})";
    refused_bodies("POST", pattern, here, ines, guest, R"({"experience": "master"})");
    expect("POST", pattern, here, 403, ines, json{{"experience", "novice"}, {"user_id", tom_id}}.dump());
    expect("POST", pattern, here, 409, anna, json{{"experience", "novice"}, {"user_id", tom_id}}.dump());
    expect("POST", pattern, here, 422, anna, R"({"experience": "novice", "user_id": "x", "name": "X"})");
    expect("POST", pattern, here, 404, anna, R"({"experience": "novice", "user_id": "nobody"})");
    expect("POST", pattern, here, 201, ines, guest);
    guest_code = made(anna, here, R"({"experience": "expert", "name": "The man from Ulm"})").at("code");
    expect("GET", pattern, here, 200, ines);
    expect("GET", pattern, here, 200, anna);
    expect("GET", pattern, here, 401);
    expect("GET", pattern, here, 403, tom);
    expect("GET", pattern, studies + "/nothing/participants", 404, ines);
    expect("PUT", one_study, at, 409, ines, R"({"name": "First year", "cases": ["unplanned"]})");
    expect("GET", one_study, at, 200, tom);
  }

  void answering() {
    const std::string pattern = participant + "/answers", here = at + "/participants/" + code + "/answers";
    const std::string good = all_answers().dump();
    refused_bodies("PUT", pattern, here, tom, good, R"({"vibration": 6})");
    expect("PUT", pattern, here, 403, ines, good);
    expect("PUT", pattern, here, 404, ben, good);
    expect("PUT", pattern, here, 200, tom, good);
    expect("PUT", pattern, at + "/participants/" + guest_code + "/answers", 200, ines, good);
    const std::string person = at + "/participants/" + code;
    for (const Sent& who : {tom, ines, anna}) expect("GET", participant, person, 200, who);
    expect("GET", participant, person, 401);
    expect("GET", participant, person, 403, viewer());
    expect("GET", participant, person, 404, ben);
  }

  /// A session of Tom's in the study that has ended; its id.
  std::string trained() {
    const std::string session = made(tom, all, json{{"study", id}}.dump()).at("id");
    EXPECT_EQ(request("POST", all + "/" + session + "/start", tom).status, 200);
    EXPECT_EQ(request("POST", all + "/" + session + "/stop", tom).status, 200);
    return session;
  }

  void naming_raters() {
    const std::string pattern = one_study + "/raters", here = at + "/raters";
    const std::string good = json{{"user_id", ivo_id}}.dump();
    refused_bodies("POST", pattern, here, anna, good, "{}");
    expect("POST", pattern, here, 403, ines, good);
    expect("POST", pattern, here, 404, anna, R"({"user_id": "nobody"})");
    const HttpReply reply = request("POST", here, anna, good);
    expect_as_described("POST", pattern, 201, reply);
    expect("POST", pattern, here, 409, anna, good);
    expect("GET", pattern, here, 200, ines);
    expect("GET", pattern, here, 401);
    expect("GET", pattern, here, 403, tom);
    expect("GET", pattern, studies + "/nothing/raters", 404, ines);
    const std::string rater = pattern + "/{label}";
    made(anna, here, json{{"user_id", ines_id}}.dump());
    expect("DELETE", rater, here + "/R2", 401);
    expect("DELETE", rater, here + "/R2", 403, ines);
    expect("DELETE", rater, here + "/R2", 204, anna);
    expect("DELETE", rater, here + "/R2", 404, anna);
  }

  void rating() {
    naming_raters();
    const std::string session = trained();
    const std::string pattern = one_study + "/rating-queue", here = at + "/rating-queue";
    expect("GET", pattern, here, 200, ivo);
    expect("GET", pattern, here, 401);
    expect("GET", pattern, here, 403, tom);
    expect("GET", pattern, here, 404, ines);
    const json queue = json::parse(request("GET", here, ivo).body).at("queue");
    ASSERT_EQ(queue.size(), 1u);
    const std::string place = pattern + "/{key}", key = here + "/" + queue[0].at("key").get<std::string>();
    rating_key = key;
    json answers = json::object();
    for (const auto& item : study::default_rating_form().items)
      if (item.required) answers[item.id] = item.options.empty() ? json(3) : json(item.options[0].id);
    refused_bodies("PUT", place, key, ivo, answers.dump(), R"({"respect_for_bone": 6})");
    expect("PUT", place, key, 403, tom, answers.dump());
    expect("PUT", place, here + "/0123456789abcdef", 404, ivo, answers.dump());
    expect("PUT", place, key, 200, ivo, answers.dump());
    rating_answers = answers.dump();
    const std::string replay = place + "/replay";
    expect("POST", replay, key + "/replay", 201, ivo);
    engine->refuse_replay = [] { throw Error(ErrorKind::invalid_input, "recording.ream is damaged"); };
    expect("POST", replay, key + "/replay", 422, ivo);
    engine->refuse_replay = [] {};
    expect("POST", replay, key + "/replay", 401);
    expect("POST", replay, key + "/replay", 403, tom);
    expect("POST", replay, here + "/0123456789abcdef/replay", 404, ivo);
    // What is rated is seen in the queue only.
    const std::string path = "/api/v1/sessions/" + session;
    for (const char* part : {"", "/score", "/metrics", "/replay"})
      EXPECT_EQ(request(part == std::string("/replay") ? "POST" : "GET", path + part, ivo).status, 403)
          << part;
    EXPECT_EQ(request("GET", path, ines).status, 200);
    for (const std::string& query : {std::string(), "?participant=" + code, "?study=" + id + "&sort=-points"})
      EXPECT_EQ(json::parse(request("GET", "/api/v1/sessions" + query, ivo).body).at("total"), 0) << query;
    EXPECT_EQ(json::parse(request("GET", "/api/v1/scores", ivo).body).dump().find(code), std::string::npos);
    EXPECT_EQ(request("POST", path + "/stop", ivo).status, 409)
        << "ended; whoever is beside a device may stop it";
    const std::string open = json::parse(request("POST", key + "/replay", ivo).body).at("id");
    for (const std::string& answer :
         {request("GET", all + "/" + open, ivo).body, request("GET", all, anna).body})
      EXPECT_EQ(answer.find("\"replay_of\":\"" + session), std::string::npos) << answer;
    EXPECT_EQ(request("GET", all + "/" + open + "/metrics", ivo).status, 403);
    EXPECT_EQ(request("POST", "/api/v1/links", ivo, "{}").status, 409);
    EXPECT_EQ(request("POST", all, ivo, json{{"study", id}, {"participant", code}}.dump()).status, 409);
  }

  void validity() {
    const std::string pattern = one_study + "/validity", here = at + "/validity";
    for (const char* form : {"", "?form=numbers", "?form=sessions", "?form=ratings", "?form=script"})
      expect("GET", pattern, here + form, 200, anna);
    expect("GET", pattern, here, 401);
    expect("GET", pattern, here, 403, tom);
    expect("GET", pattern, studies + "/nothing/validity", 404, anna);
    expect("GET", pattern, here, 409, ines);
    expect("GET", pattern, here + "?form=xls", 422, anna);
  }

  void feeling() {
    for (const char* unusable : {R"({"name": "F", "feel": {}, "cases": ["planned"]})",
                                 R"({"name": "F", "feel": {"comparisons": ["cartilage", "cartilage"]}})",
                                 R"({"name": "F", "feel": {"trials_per_comparison": 3}})"})
      expect("POST", studies, studies, 422, ines, unusable);
    const json study =
        made(ines, studies, R"({"name": "Feel", "device": "browser", "feel": {"trials_per_comparison": 2}})");
    EXPECT_EQ(study.at("feel").at("comparisons").size(), 4u);
    EXPECT_TRUE(study.at("rating_form").is_null());
    const std::string feel = study.at("id"), place = studies + "/" + feel;
    const std::string own = made(tom, studies + "/join",
                                 json{{"join_code", study.at("join_code")}, {"experience", "expert"}}.dump())
                                .at("code");
    const std::string pattern = participant + "/feel-trial",
                      here = place + "/participants/" + own + "/feel-trial";
    expect("GET", pattern, here, 200, tom);
    expect("GET", pattern, here, 200, ines);
    expect("GET", pattern, here, 401);
    expect("GET", pattern, here, 403, viewer());
    expect("GET", pattern, here, 404, ben);
    expect("GET", pattern, at + "/participants/" + code + "/feel-trial", 409, tom);
    const std::string good = R"({"number": 1, "chosen": "upper"})";
    refused_bodies("PUT", pattern, here, tom, good, R"({"number": 1, "chosen": "left"})");
    expect("PUT", pattern, here, 403, ines, good);
    expect("PUT", pattern, here, 404, ben, good);
    expect("PUT", pattern, here, 409, tom, good);
    const json session = made(tom, all, json{{"study", feel}}.dump());
    EXPECT_EQ(session.at("phase"), "feel");
    EXPECT_TRUE(session.at("theatre").get<bool>());
    const std::string path = all + "/" + session.at("id").get<std::string>();
    EXPECT_EQ(request("POST", path + "/start", tom).status, 200);
    expect("PUT", pattern, here, 409, tom, good);
    EXPECT_EQ(request("POST", path + "/stop", tom).status, 200);
    for (const Sent& who : {tom, ines}) {
      for (const char* part : {"/metrics", "/score", "/trace", "/recording", "/session.json"})
        EXPECT_EQ(request("GET", path + part, who).status, 403) << part;
      EXPECT_EQ(request("POST", path + "/replay", who).status, 403);
      EXPECT_EQ(request("GET", path, who).status, 200);
    }
    EXPECT_EQ(request("POST", path + "/reset", tom).status, 409) << "the next one begins from the study";
    expect("PUT", pattern, here, 200, tom, good);
    expect("PUT", pattern, here, 409, tom, good);
    const std::string report = one_study + "/feel", there = place + "/feel";
    expect("GET", report, there, 200, anna);
    expect("GET", report, there + "?form=answers", 200, anna);
    expect("GET", report, there, 401);
    expect("GET", report, there, 403, tom);
    expect("GET", report, studies + "/nothing/feel", 404, anna);
    expect("GET", report, there, 409, ines);
    expect("GET", report, at + "/feel", 409, anna);
    EXPECT_EQ(request("POST", place + "/close", ines).status, 200);
    EXPECT_EQ(request("GET", there, ines).status, 200);
    EXPECT_EQ(request("GET", path + "/metrics", tom).status, 200);
  }

  void planning() {
    const std::string size = "/api/v1/sample-size", means = size + "?question=means&effect=0.8";
    expect("GET", size, means, 200, ines);
    expect("GET", size, size + "?question=shares&first=0.5&second=0.8", 200, ines);
    expect("GET", size, size + "?question=agreement&least=0.5&expected=0.8&raters=2", 200, ines);
    expect("GET", size, size + "?question=precision&width=0.2&expected=0.8&raters=2", 200, ines);
    expect("GET", size, size, 400, ines);
    expect("GET", size, means, 401);
    expect("GET", size, means, 403, tom);
    expect("GET", size, size + "?question=means", 422, ines);
    expect("GET", size, size + "?question=agreement&least=0.8&expected=0.5&raters=2", 422, ines);
  }

  void exporting() {
    const std::string pattern = one_study + "/export", here = at + "/export";
    expect("GET", pattern, here, 200, anna);
    expect("GET", pattern, here + "?format=csv", 200, anna);
    expect("GET", pattern, here + "?format=csv&table=groups", 200, anna);
    expect("GET", pattern, here, 401);
    expect("GET", pattern, here, 403, tom);
    expect("GET", pattern, studies + "/nothing/export", 404, anna);
    expect("GET", pattern, here, 409, ines);
    expect("GET", pattern, here + "?format=xls", 422, anna);
    const std::string codebook = one_study + "/codebook";
    expect("GET", codebook, at + "/codebook", 200, ines);
    expect("GET", codebook, at + "/codebook", 401);
    expect("GET", codebook, at + "/codebook", 403, tom);
    expect("GET", codebook, studies + "/nothing/codebook", 404, ines);
  }

  void expect_step(const std::string& word, int status, const Sent& sent = {}, const std::string& of = {}) {
    expect("POST", one_study + "/" + word, (of.empty() ? at : studies + "/" + of) + "/" + word, status, sent);
  }
  void ending() {
    const std::string persons = one_study + "/persons";
    expect("GET", persons, at + "/persons", 200, anna);
    expect("GET", persons, at + "/persons", 401);
    expect("GET", persons, at + "/persons", 403, ines);
    expect("GET", persons, studies + "/nothing/persons", 404, anna);
    for (const char* word : {"close", "reopen", "unblind"}) {
      expect_step(word, 401);
      expect_step(word, 403, tom);
      expect_step(word, 404, anna, "nothing");
    }
    expect_step("reopen", 409, ines);
    const std::string plain = made(ines, studies, wanted).at("id");
    expect_step("close", 200, ines, plain);
    expect_step("reopen", 200, ines, plain);
    expect_step("unblind", 409, anna);
    expect_step("close", 200, ines);
    expect_step("close", 409, ines);
    expect("PUT", participant + "/answers", at + "/participants/" + code + "/answers", 409, tom,
           all_answers().dump());
    expect("PUT", one_study + "/rating-queue/{key}", rating_key, 409, ivo, rating_answers);
    expect("DELETE", one_study + "/raters/{label}", at + "/raters/R1", 409, anna);
    expect_step("reopen", 409, ines);
    expect_step("unblind", 403, ines);
    expect_step("unblind", 200, anna);
    expect("GET", persons, at + "/persons", 200, ines);
  }

  void forgetting() {
    const std::string person = at + "/participants/" + code;
    expect("DELETE", one_study, at, 409, anna);
    expect("DELETE", participant, person, 401);
    expect("DELETE", participant, person, 403, ines);
    expect("DELETE", participant, person, 204, anna);
    expect("DELETE", participant, person, 404, anna);
    const std::string other = made(ines, studies, wanted).at("id");
    expect("DELETE", one_study, studies + "/" + other, 401);
    expect("DELETE", one_study, studies + "/" + other, 403, ines);
    expect("DELETE", one_study, studies + "/" + other, 204, anna);
    expect("DELETE", one_study, studies + "/" + other, 404, anna);
  }

  void while_the_database_is_away() {
    const auto hog = start_without_database();
    for (const auto& [operation, status] : described({"studies"})) {
      if (status != 503) continue;
      const std::string method = operation.substr(0, operation.find(' '));
      const std::string pattern = operation.substr(operation.find(' ') + 1);
      std::string path = pattern;
      for (const auto& [name, value] :
           {std::pair("{id}", "s1"), {"{code}", "K7-F3M"}, {"{label}", "R1"}, {"{key}", "0123456789abcdef"}})
        if (const size_t place = path.find(name); place != std::string::npos)
          path.replace(place, std::string(name).size(), value);
      if (path == "/api/v1/sample-size") path += "?question=means&effect=1";
      const bool joins = path.ends_with("/join");
      const std::string body = path == studies || path == studies + "/s1" ? wanted
                               : joins                     ? R"({"join_code": "x", "experience": "novice"})"
                               : path.ends_with("/raters") ? R"({"user_id": "u1"})"
                               : path.ends_with("/feel-trial") ? R"({"number": 1, "chosen": "upper"})"
                               : path.ends_with("/replay")     ? ""
                               : path.ends_with("/answers") || path.find("rating-queue") != std::string::npos
                                   ? "{}"
                                   : R"({"experience": "novice"})";
      expect(method, pattern, path, 503, {}, method == "POST" || method == "PUT" ? body : "");
    }
  }

  Sent viewer() {
    const auto link = issue(access::CredentialKind::link, {"", {}, "visit", "", ""});
    return page_after(post("/api/v1/login/link", json{{"secret", link.secret.reveal()}}.dump()));
  }

  const std::string studies = "/api/v1/studies", one_study = studies + "/{id}",
                    participant = one_study + "/participants/{code}",
                    wanted = R"({"name": "First year", "cases": ["planned"], "device": "browser"})";
  Sent anna, ines, ivo, tom, ben;
  std::string rating_key, rating_answers, tom_id, ines_id, ivo_id, id, at, join_code, code, guest_code;
};

TEST_F(StudyContractTest, EveryDescribedReplyIsGivenAsDescribed) {
  making();
  changing();
  taking_part();
  answering();
  rating();
  validity();
  feeling();
  planning();
  exporting();
  ending();
  forgetting();
  while_the_database_is_away();
  expect_all_given({"studies"});
}

}  // namespace
}  // namespace ream::test
