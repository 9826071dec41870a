#include "study/study_service.hpp"

#include <gtest/gtest.h>

#include <regex>

#include "api/replies.hpp"
#include "core/new_id.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace ream::study {
namespace {

using nlohmann::json;
using test::expect_error;
using Codes = std::vector<std::string>;

const net::Caller the_operator{"u-op", "Olga Operator", "operator", "", ""};
const net::Caller instructor{"u-in", "Ines Instructor", "instructor", "", ""};
const net::Caller ada{"u-ada", "Ada Lovelace", "trainee", "", ""};
const net::Caller bob{"u-bob", "Bob Builder", "trainee", "", ""};
const net::Caller viewer{"", "", "viewer", "", ""};

/// What somebody is refused with: a status of HTTP, 0 when they are not.
template <typename Action>
int refused(Action&& action) {
  try {
    action();
  } catch (const net::RequestError& error) {
    return error.status();
  } catch (const Error& error) {
    return net::http_status(error.kind());
  }
  return 0;
}

/// A server with two users and every case but one.
class FakeServer final : public StudyDependencies {
 public:
  explicit FakeServer(const std::vector<session::SessionRecord>& sessions) : sessions_(sessions) {}
  std::optional<StudyUser> find_user(const std::string& id) const override {
    for (const net::Caller& one : {ada, bob, instructor, the_operator})
      if (id == one.user_id) return StudyUser{one.name, one.role};
    return std::nullopt;
  }
  bool has_case(const std::string& id) const override { return id != "missing"; }
  bool has_live_session(const std::string&, const std::string&) const override { return false; }
  std::vector<session::SessionRecord> sessions(const std::string&) const override { return sessions_; }
  json metrics(const std::string&) const override { return json::object(); }

 private:
  const std::vector<session::SessionRecord>& sessions_;
};

class StudyServiceTest : public testing::Test {
 protected:
  static StudyDraft draft(const std::vector<std::string>& cases = {"demo", "hard"}) {
    return {"First year",
            "Who presses too hard?",
            {cases, "practice", "browser", "touch", std::nullopt, default_rating_form()},
            face_validity_questionnaire()};
  }
  std::string made() { return service_.create(draft()).id; }
  std::string join(const net::Caller& who, const std::string& id, const std::string& level = "novice") {
    return service_.join(who, {level, 2, "", "", service_.get(the_operator, id).join_code}).second.code;
  }
  static json answers() {
    json all = json::object();
    for (const auto& item : face_validity_questionnaire().items)
      if (item.required) all[item.id] = 3;
    return all;
  }

  test::TemporaryFolder folder_;
  store::Database database_{"sqlite:" + (folder_.path() / "ream.db").string()};
  std::vector<session::SessionRecord> sessions_;
  StudyService service_{database_, std::make_unique<FakeServer>(sessions_)};
};

TEST_F(StudyServiceTest, KeepsWhatAStudyIsMadeOf) {
  const Study study = service_.create(draft());
  const Study kept = service_.get(instructor, study.id);
  EXPECT_EQ(kept.name, "First year");
  EXPECT_EQ(kept.settings.cases, (std::vector<std::string>{"demo", "hard"}));
  EXPECT_EQ(kept.settings.device, "browser");
  EXPECT_TRUE(kept.open);
  EXPECT_TRUE(kept.blinded());
  EXPECT_EQ(to_json(*kept.questionnaire), to_json(face_validity_questionnaire()));
  EXPECT_EQ(kept.join_code, study.join_code);
  EXPECT_NE(kept.join_code, kept.id);
  expect_error(ErrorKind::not_found, "missing", [&] { service_.create(draft({"missing"})); });
}

TEST_F(StudyServiceTest, ItsSettingsStandStillOnceSomebodyTakesPart) {
  const std::string id = made();
  service_.change(id, draft({"hard"}));
  EXPECT_EQ(service_.get(instructor, id).settings.cases, std::vector<std::string>{"hard"});
  join(ada, id);
  StudyDraft renamed = draft({"hard"});
  renamed.name = "Second year";
  EXPECT_EQ(service_.change(id, renamed).name, "Second year");
  expect_error(ErrorKind::conflict, "takes part", [&] { service_.change(id, draft({"demo"})); });
  renamed.questionnaire.reset();
  expect_error(ErrorKind::conflict, "takes part", [&] { service_.change(id, renamed); });
  expect_error(ErrorKind::conflict, "takes part", [&] { service_.remove(id); });
}

TEST_F(StudyServiceTest, TraineesKnowTheStudiesTheyTakePartIn) {
  const std::string first = made(), second = made();
  EXPECT_TRUE(service_.list(ada).empty());
  EXPECT_EQ(refused([&] { service_.get(ada, first); }), 404);
  join(ada, first);
  ASSERT_EQ(service_.list(ada).size(), 1u);
  EXPECT_EQ(service_.get(ada, first).id, first);
  EXPECT_EQ(refused([&] { service_.get(ada, second); }), 404);
  EXPECT_EQ(service_.list(instructor).size(), 2u);
  EXPECT_TRUE(service_.list(viewer).empty());
}

TEST_F(StudyServiceTest, PeopleJoinOnceByCodeWhileItIsOpen) {
  const std::string id = made();
  const std::string code = join(ada, id);
  EXPECT_EQ(service_.code_of(ada, id), code);
  expect_error(ErrorKind::conflict, "already", [&] { join(ada, id); });
  EXPECT_NE(join(bob, id), code);
  EXPECT_EQ(refused([&] { service_.join(bob, {"novice", 0, "", "", "nothing"}); }), 404);
  EXPECT_EQ(refused([&] { join(viewer, id); }), 409) << "only somebody with an account";
  service_.close(id);
  EXPECT_EQ(refused([&] { join(instructor, id); }), 409);
  service_.reopen(id);
  EXPECT_NE(join(instructor, id), "");
}

TEST_F(StudyServiceTest, OnlyOperatorsSayWhoAParticipantIs) {
  const std::string id = made();
  EXPECT_EQ(refused([&] { service_.enrol(instructor, id, {"novice", 0, ada.user_id, "", ""}); }), 403);
  EXPECT_EQ(refused([&] { service_.enrol(instructor, id, {"novice", 0, "", "The man from Ulm", ""}); }), 403);
  EXPECT_EQ(refused([&] { service_.enrol(the_operator, id, {"novice", 0, "u-nobody", "", ""}); }), 404);
  const std::string unnamed = service_.enrol(instructor, id, {"expert", 90, "", "", ""}).code;
  const std::string code = service_.enrol(the_operator, id, {"novice", 0, ada.user_id, "", ""}).code;
  const std::string guest = service_.enrol(the_operator, id, {"expert", 0, "", "The man from Ulm", ""}).code;
  EXPECT_EQ(service_.code_of(ada, id), code);
  EXPECT_EQ(refused([&] { service_.persons(instructor, id); }), 403);
  std::map<std::string, std::string> names;
  for (const auto& person : service_.persons(the_operator, id)) names[person.code] = person.name;
  EXPECT_EQ(names, (std::map<std::string, std::string>{{code, ada.name}, {guest, "The man from Ulm"}}));
  EXPECT_EQ(service_.participants(the_operator, id).size(), 3u);
  EXPECT_FALSE(names.contains(unnamed));
}

TEST_F(StudyServiceTest, WhoScoresKnowsTheCodeOnly) {
  const std::string id = made(), code = join(ada, id, "expert");
  service_.answer(ada, id, code, answers());
  const Participant seen = service_.participant(instructor, id, code);
  EXPECT_EQ(api::to_json(seen), (json{{"code", code},
                                      {"experience", nullptr},
                                      {"procedures_done", nullptr},
                                      {"answers", nullptr},
                                      {"has_account", true},
                                      {"arm", nullptr}}));
  EXPECT_EQ(api::to_json(service_.participants(instructor, id)[0]), api::to_json(seen));
  EXPECT_EQ(service_.participant(the_operator, id, code).experience, "expert");
  EXPECT_EQ(service_.participant(ada, id, code).answers, answers());
  EXPECT_EQ(refused([&] { service_.participant(bob, id, code); }), 404);
  EXPECT_EQ(refused([&] { service_.export_all(instructor, id); }), 409);
  EXPECT_EQ(service_.export_all(the_operator, id).answers.rows.size(), 1u);
  service_.close(id);
  EXPECT_EQ(service_.participant(instructor, id, code).experience, "expert");
  EXPECT_EQ(service_.export_all(instructor, id).answers.rows.size(), 1u);
  EXPECT_EQ(refused([&] { service_.persons(instructor, id); }), 403) << "closed is not unblinded";
}

TEST_F(StudyServiceTest, IsUnblindedOnceClosedAndForGood) {
  const std::string id = made(), code = join(ada, id);
  expect_error(ErrorKind::conflict, "close", [&] { service_.unblind(id); });
  service_.close(id);
  expect_error(ErrorKind::conflict, "closed", [&] { service_.close(id); });
  EXPECT_FALSE(service_.unblind(id).blinded());
  EXPECT_EQ(service_.persons(instructor, id).at(0).name, ada.name);
  expect_error(ErrorKind::conflict, "already", [&] { service_.unblind(id); });
  expect_error(ErrorKind::conflict, "unblinded", [&] { service_.reopen(id); });
}

TEST_F(StudyServiceTest, AnswersAreOnesOwnAndMayChangeUntilItCloses) {
  const std::string id = made(), code = join(ada, id);
  EXPECT_EQ(refused([&] { service_.answer(bob, id, code, answers()); }), 404);
  EXPECT_EQ(refused([&] { service_.answer(instructor, id, code, answers()); }), 403);
  EXPECT_EQ(refused([&] { service_.answer(the_operator, id, code, answers()); }), 403);
  json incomplete = answers();
  incomplete.erase("vibration");
  EXPECT_EQ(refused([&] { service_.answer(ada, id, code, incomplete); }), 422);
  service_.answer(ada, id, code, answers());
  json changed = answers();
  changed["vibration"] = 5;
  service_.answer(ada, id, code, changed);
  EXPECT_EQ(service_.participant(ada, id, code).answers, changed);
  service_.close(id);
  EXPECT_EQ(refused([&] { service_.answer(ada, id, code, answers()); }), 409);
  EXPECT_EQ(service_.participant(ada, id, code).answers, changed);
}

TEST_F(StudyServiceTest, WhoRunsTheStudyAnswersForThoseWithoutAnAccount) {
  const std::string id = made(), code = service_.enrol(instructor, id, {"expert", 9, "", "", ""}).code;
  service_.answer(instructor, id, code, answers());
  EXPECT_EQ(service_.participant(the_operator, id, code).answers, answers());
  StudyDraft silent = draft();
  silent.questionnaire.reset();
  const std::string asks_nothing = service_.create(silent).id;
  const std::string other = service_.enrol(instructor, asks_nothing, {"expert", 9, "", "", ""}).code;
  EXPECT_EQ(refused([&] { service_.answer(instructor, asks_nothing, other, json::object()); }), 409);
}

TEST_F(StudyServiceTest, WhoWithdrawsIsForgotten) {
  const std::string id = made(), code = join(ada, id);
  service_.answer(ada, id, code, answers());
  session::SessionRecord session;
  session.request.participant = code;
  session.request.created_utc = "2026-01-01T00:00:00Z";
  session.status.state = SessionState::finished;
  sessions_.push_back(session);
  EXPECT_EQ(service_.export_all(the_operator, id).sessions.rows.size(), 1u);
  service_.withdraw(id, code);
  EXPECT_TRUE(service_.persons(the_operator, id).empty());
  EXPECT_TRUE(service_.export_all(the_operator, id).sessions.rows.empty());
  EXPECT_EQ(refused([&] { service_.withdraw(id, code); }), 404);
  service_.remove(id);
  EXPECT_EQ(refused([&] { service_.get(the_operator, id); }), 404);
}

TEST_F(StudyServiceTest, ASessionOfAStudyIsAsTheStudySays) {
  const std::string id = made(), code = join(ada, id);
  session::SessionRequest wanted;
  wanted.study = id;
  service_.admit(ada, wanted);
  EXPECT_EQ(wanted.participant, code);
  EXPECT_EQ(wanted.trainee_id, ada.user_id);
  EXPECT_EQ(wanted.trainee, ada.name);
  EXPECT_EQ(wanted.case_id, "demo");
  EXPECT_EQ(wanted.script, "practice");
  EXPECT_EQ(wanted.device, "browser");
  EXPECT_EQ(wanted.device_profile, "touch");
  session::SessionRequest by_staff;
  by_staff.study = id;
  by_staff.participant = code;
  by_staff.case_id = "hard";
  service_.admit(instructor, by_staff);
  EXPECT_EQ(by_staff.trainee_id, ada.user_id) << "it is the trainee's session, whoever starts it";
  EXPECT_EQ(by_staff.case_id, "hard");
}

TEST_F(StudyServiceTest, ASessionIsRefusedThatDoesNotBelong) {
  const std::string id = made(), code = join(ada, id);
  const auto admit = [&](const net::Caller& caller, const std::string& study, const std::string& participant,
                         const std::string& case_id) {
    session::SessionRequest wanted;
    wanted.study = study;
    wanted.participant = participant;
    wanted.case_id = case_id;
    return refused([&] { service_.admit(caller, wanted); });
  };
  EXPECT_EQ(admit(ada, id, code, "demo"), 0);
  EXPECT_EQ(admit(ada, id, "", "easy"), 409);
  EXPECT_EQ(admit(ada, "nothing", "", "demo"), 404);
  EXPECT_EQ(admit(bob, id, "", "demo"), 404);
  EXPECT_EQ(admit(bob, id, code, "demo"), 404);
  EXPECT_EQ(admit(instructor, id, "", "demo"), 409) << "who trains is not said";
  EXPECT_EQ(admit(instructor, id, "AA-AAA", "demo"), 404);
  join(bob, id);
  EXPECT_EQ(admit(bob, id, code, "demo"), 404) << "nobody trains under another's code";
  service_.close(id);
  EXPECT_EQ(admit(ada, id, code, "demo"), 409);
}

TEST(ParticipantCode, IsReadableAndDrawnAtRandom) {
  const std::regex shape("[2-9B-DF-HJKMNP-TV-Z]{2}-[2-9B-DF-HJKMNP-TV-Z]{3}");
  std::set<std::string> drawn;
  for (int i = 0; i < 500; ++i) {
    const std::string code = random_participant_code();
    EXPECT_TRUE(std::regex_match(code, shape)) << code;
    drawn.insert(code);
  }
  EXPECT_GT(drawn.size(), 495u);
}

}  // namespace
}  // namespace ream::study
