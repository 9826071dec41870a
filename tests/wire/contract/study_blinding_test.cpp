#include <random>
#include "api/routes.hpp"

#include "access_fixture.hpp"
#include "support/seed.hpp"
#include "support/some_metrics.hpp"

namespace ream::test {
namespace {

using access::Role;

/// People with made-up names who take part in a study, and everything that others can fetch about it.
class StudyBlindingTest : public AccessTest {
 protected:
  struct Person {
    std::string id, login, name, code;
    Sent token;
  };

  void SetUp() override {
    options.sessions.live = 100;
    start();
    anna = token_of(add_user("anna", Role::operator_));
    ines = token_of(add_user("ines", Role::instructor));
    outsider = token_of(add_user("outsider", Role::trainee));
    const json study =
        made(ines, studies, {{"name", "Blind"}, {"cases", {"planned"}}, {"device", "browser"}});
    study_id = study.at("id");
    for (int i = 0; i < 4; ++i) add_person(study.at("join_code"));
  }

  json made(const Sent& who, const std::string& path, const json& body) {
    const HttpReply reply = request("POST", path, who, body.dump());
    EXPECT_EQ(reply.status, 201) << reply.body;
    return json::parse(reply.body);
  }
  int status_of(const std::string& method, const std::string& path, const Sent& who, const json& body) {
    return request(method, path, who, body.dump()).status;
  }
  json seen(const std::string& path, const Sent& who) { return json::parse(request("GET", path, who).body); }

  std::string made_up() {
    std::string word;
    for (int i = 0; i < 12; ++i) word += static_cast<char>('a' + random() % 26);
    return word;
  }
  void add_person(const std::string& join_code) {
    Person person{{}, made_up(), "Dr. " + made_up() + " " + made_up(), {}, {}};
    const access::Secret password("password of " + person.login);
    person.id = access_control().users.add({person.login, person.name, Role::trainee, password}).id;
    person.token = token_of(person.id);
    const std::string level = random() % 2 ? "novice" : "expert";
    person.code =
        made(person.token, studies + "/join", {{"join_code", join_code}, {"experience", level}}).at("code");
    people.push_back(person);
  }

  /// A session of the person's, begun by themself or by who watches, with a remark of theirs.
  void train(const Person& person, bool by_staff) {
    json wanted = {{"case", "planned"}, {"study", study_id}};
    if (by_staff) wanted["participant"] = person.code;
    const json session = made(by_staff ? ines : person.token, all, wanted);
    if (by_staff) expect_nothing_of(person, session.dump(), "the answer to who began the session");
    const std::string id = session.at("id"), at = all + "/" + id;
    sessions.push_back(id);
    EXPECT_EQ(request("POST", at + "/start", person.token).status, 200);
    made(person.token, at + "/annotations", {{"words", "steep"}, {"author", person.name}});
    expect_nothing_of(person, request("GET", at + "/annotations", ines).body, "annotations");
    for (const char* word : {"pause", "start", "stop"})
      expect_nothing_of(person, request("POST", at + "/" + word, ines).body, word);
    leave_results(id, person);
  }

  /// What a session leaves in its folder, which names the person.
  void leave_results(const std::string& id, const Person& person) {
    const json session = {{"case", "planned"},          {"script", "practice"},
                          {"state", "stopped"},         {"trainee_id", person.id},
                          {"trainee", person.name},     {"study", study_id},
                          {"participant", person.code}, {"created_utc", "2026-01-31T12:00:00Z"}};
    folder.write("sessions/" + id + "/session.json", session.dump());
    folder.write("sessions/" + id + "/metrics.json", some_metrics(10.0).dump());
  }

  static void expect_nothing_of(const Person& person, const std::string& text, const std::string& where) {
    for (const std::string& secret : {person.id, person.login, person.name})
      EXPECT_EQ(text.find(secret), std::string::npos) << where << " tells of " << person.name << ":\n"
                                                      << text;
  }

  /// Every GET route of the server with every id that there is. A route with a new parameter must be added.
  std::vector<std::string> everything() const {
    std::vector<std::string> paths;
    for (const auto& route : api::routes()) {
      if (route.method != "GET" || route.pattern.starts_with("/api/v1/users")) continue;
      std::vector<std::string> filled = {route.pattern};
      fill(filled, "{code}", {people[0].code, people[1].code});
      fill(filled, "{axis}", {"u"});
      fill(filled, "{index}", {"1"});
      if (route.pattern.starts_with(all)) fill(filled, "{id}", sessions);
      if (route.pattern.starts_with(studies)) fill(filled, "{id}", {study_id});
      fill(filled, "{id}", {"planned"});
      for (const std::string& path : filled) {
        EXPECT_EQ(path.find('{'), std::string::npos) << "this test must know what to put into " << path;
        paths.push_back(path);
      }
    }
    for (const Person& person : people)
      for (const std::string& query :
           {"trainee=" + person.id, "q=" + person.login, std::string("sort=trainee")})
        paths.push_back(all + "?" + query);
    for (const Person& person : people) {
      for (const char* list : {"/api/v1/scores?format=csv&", "/api/v1/scores?", "/api/v1/learning?"})
        for (const std::string& query : {"trainee=" + person.id, "participant=" + person.code})
          paths.push_back(list + query);
    }
    return paths;
  }
  static void fill(std::vector<std::string>& paths, const std::string& parameter,
                   const std::vector<std::string>& values) {
    std::vector<std::string> filled;
    for (const std::string& path : paths) {
      const size_t at = path.find(parameter);
      if (at == std::string::npos) filled.push_back(path);
      for (const std::string& value : values)
        if (at != std::string::npos) filled.push_back(std::string(path).replace(at, parameter.size(), value));
    }
    paths = filled;
  }

  /// What is not about `self` must name nobody.
  void expect_blind(const Sent& who, const std::string& words, const Person* self = nullptr) {
    int answered = 0;
    for (const std::string& path : everything()) {
      const HttpReply reply = request("GET", path, who);
      answered += reply.status == 200 ? 1 : 0;
      for (const Person& person : people)
        if (&person != self) expect_nothing_of(person, reply.body, words + " GET " + path);
    }
    EXPECT_GT(answered, 5) << words;
  }

  std::mt19937 random{test::seed()};
  const std::string studies = "/api/v1/studies";
  Sent anna, ines, outsider;
  std::string study_id;
  std::vector<Person> people;
  std::vector<std::string> sessions;
};

TEST_F(StudyBlindingTest, NobodyButOperatorsLearnsWhoAParticipantIs) {
  for (const Person& person : people) {
    train(person, false);
    train(person, true);
  }
  const auto link = issue(access::CredentialKind::link, {"", {}, "visit", "", ""});
  const Sent viewer = page_after(post("/api/v1/login/link", json{{"secret", link.secret.reveal()}}.dump()));
  expect_blind(ines, "an instructor");
  expect_blind(viewer, "a viewer");
  expect_blind(outsider, "another trainee");
  expect_blind(people[0].token, "a participant", &people[0]);
  for (const std::string& id : sessions) {
    const json session = seen(all + "/" + id, ines);
    EXPECT_EQ(session.at("trainee"), session.at("participant"));
    EXPECT_TRUE(session.at("trainee_id").is_null());
  }
  // A list that is asked for a person must not tell which codes are theirs.
  for (const Person& person : people)
    for (const std::string& query : {"trainee=" + person.id, "q=" + person.login, "q=" + person.id}) {
      for (const Sent& who : {ines, viewer}) EXPECT_EQ(seen(all + "?" + query, who).at("total"), 0) << query;
      EXPECT_EQ(seen(all + "?" + query, anna).at("total"), query.starts_with("trainee=") ? 2 : 0) << query;
    }
  EXPECT_EQ(seen(all + "?q=" + people[0].code, ines).at("total"), 2);
  EXPECT_EQ(seen(all, people[0].token).at("total"), 2) << "everybody has their own";
  // Codes do not stand where persons stand.
  const std::string users = request("GET", "/api/v1/users", ines).body;
  for (const Person& person : people) EXPECT_EQ(users.find(person.code), std::string::npos);
  EXPECT_EQ(status_of("POST", studies + "/" + study_id + "/close", ines, {}), 200);
  expect_blind(ines, "an instructor after the close");
}

TEST_F(StudyBlindingTest, OperatorsAndThePersonKnowAndAllWhoSeeItOnceItIsUnblinded) {
  train(people[0], false);
  const std::string study = studies + "/" + study_id, session = all + "/" + sessions[0];
  EXPECT_EQ(seen(session, anna).at("trainee"), people[0].name);
  EXPECT_EQ(seen(session, people[0].token).at("trainee"), people[0].name);
  EXPECT_EQ(request("POST", study + "/close", ines).status, 200);
  EXPECT_EQ(request("POST", study + "/unblind", anna).status, 200);
  EXPECT_EQ(seen(session, ines).at("trainee"), people[0].name);
  EXPECT_NE(request("GET", study + "/persons", ines).body.find(people[0].name), std::string::npos);
  for (const char* query : {"", "?format=csv", "?format=csv&table=answers", "?format=csv&table=groups"})
    for (const Person& person : people)
      expect_nothing_of(person, request("GET", study + "/export" + query, anna).body, query);
  const std::string audit = request("GET", "/api/v1/audit", anna).body;
  for (const char* action : {"study.create", "study.join", "study.unblind", "study.persons", "study.export"})
    EXPECT_NE(audit.find(action), std::string::npos) << action;
}

/// Asked for a person, others than operators get nothing of a study; asked for a code, its sessions.
TEST_F(StudyBlindingTest, LearningAndScoresAreToldByCodeOnly) {
  const Person &first = people[0], &second = people[1];
  for (int i = 0; i < 2; ++i) train(first, i == 1);
  train(second, false);
  const auto known = [this](const Sent& who, const std::string& query) {
    return seen("/api/v1/learning?" + query, who).at("sessions").size();
  };
  EXPECT_EQ(known(anna, "trainee=" + first.id), 2u);
  EXPECT_EQ(known(ines, "trainee=" + first.id), 0u);
  EXPECT_EQ(known(ines, "participant=" + first.code), 2u);
  EXPECT_EQ(known(first.token, ""), 2u);
  EXPECT_EQ(known(first.token, "trainee=" + first.id), 2u);
  EXPECT_EQ(known(first.token, "participant=" + second.code), 0u) << "of their own only";
  EXPECT_EQ(request("GET", "/api/v1/learning?trainee=" + second.id, first.token).status, 404);
  EXPECT_EQ(seen("/api/v1/scores", first.token).at("scores").size(), 2u);
  const json table = seen("/api/v1/scores", ines).at("scores");
  ASSERT_EQ(table.size(), 3u);
  for (const json& row : table)
    EXPECT_TRUE(row.at("trainee") == first.code || row.at("trainee") == second.code);
  for (const std::string& id : sessions) {
    EXPECT_EQ(request("GET", all + "/" + id + "/score", second.token).status,
              id == sessions.back() ? 200 : 404);
    EXPECT_EQ(request("POST", all + "/" + id + "/score", second.token, "{}").status, 403);
  }
}

TEST_F(StudyBlindingTest, WhoTrainsInAStudyCannotBeChangedFromOutside) {
  train(people[0], false);
  const std::string first = all + "/" + sessions[0];
  for (const Sent& who : {ines, anna}) {
    EXPECT_EQ(status_of("PATCH", first, who, {{"trainee", "Somebody"}}), 409);
    EXPECT_EQ(status_of("PATCH", first, who, {{"trainee_id", people[1].id}}), 409);
  }
  const json in_study = {{"case", "planned"}, {"study", study_id}, {"participant", people[0].code}};
  json wanted = in_study;
  wanted.erase("study");
  EXPECT_EQ(status_of("POST", all, ines, wanted), 422);
  for (const char* key : {"trainee", "device", "script", "device_profile"}) {
    wanted = in_study;
    wanted[key] = "x";
    EXPECT_EQ(status_of("POST", all, ines, wanted), 422) << key;
  }
  EXPECT_EQ(status_of("POST", all, people[1].token, in_study), 404);
  EXPECT_EQ(status_of("POST", all, people[0].token, in_study), 201);
}

}  // namespace
}  // namespace ream::test
