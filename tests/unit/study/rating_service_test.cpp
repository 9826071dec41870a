#include "study/rating_service.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "access/secret.hpp"
#include "core/new_id.hpp"
#include "study/study_sessions.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace ream::study {
namespace {

using nlohmann::json;
using test::expect_error;

const net::Caller olga{"u-olga", "Olga Operator", "operator", "", ""};
const net::Caller ines{"u-ines", "Ines Instructor", "instructor", "", ""};
const net::Caller ivo{"u-ivo", "Ivo Instructor", "instructor", "", ""};
const net::Caller tom{"u-tom", "Tom Trainee", "trainee", "", ""};

class RatedServer final : public StudyDependencies {
 public:
  explicit RatedServer(const std::vector<session::SessionRecord>& sessions) : sessions_(sessions) {}
  std::optional<StudyUser> find_user(const std::string& id) const override {
    for (const net::Caller& one : {olga, ines, ivo, tom})
      if (id == one.user_id) return StudyUser{one.name, one.role};
    return std::nullopt;
  }
  bool has_case(const std::string&) const override { return true; }
  bool has_live_session(const std::string&, const std::string& code) const override { return code == live; }
  static inline std::string live;  ///< who has one
  std::vector<session::SessionRecord> sessions(const std::string& study) const override {
    std::vector<session::SessionRecord> found;
    for (const auto& one : sessions_)
      if (one.request.study == study) found.push_back(one);
    return found;
  }
  json metrics(const std::string& session) const override {
    return session.starts_with("air") ? json{{"contact_time_s", 0.0}} : json{{"contact_time_s", 4.5}};
  }

 private:
  const std::vector<session::SessionRecord>& sessions_;
};

StudyDesign control_and_trained() {
  StudyDesign design;
  design.arms = {{"control", "Control", 0, false, "", ""}, {"trained", "Trained", 2, true, "quiet", ""}};
  design.retention_sessions = 1;
  return design;
}

class RatingServiceTest : public testing::Test {
 protected:
  std::string made(const std::optional<StudyDesign>& design = std::nullopt) {
    StudyDraft draft{
        "Who reams best?", "", {{"demo", "hard"}, "", "browser", "", design, default_rating_form()}, {}};
    return studies_.create(draft).id;
  }
  std::string participant(const std::string& study, const net::Caller& who,
                          const std::string& level = "novice") {
    return studies_.join(who, {level, 2, "", "", studies_.get(olga, study).join_code}).second.code;
  }
  void add_session(const std::string& study, const std::string& code, const std::string& id,
                   const std::string& phase = "", const std::string& utc = "2026-03-01T08:00:00Z",
                   SessionState state = SessionState::finished) {
    session::SessionRecord record;
    record.request.id = id;
    record.request.study = study;
    record.request.participant = code;
    record.request.trainee_id =
        studies_.persons(olga, study).empty() ? "" : studies_.persons(olga, study)[0].user_id;
    record.request.phase = phase;
    record.request.created_utc = utc;
    record.status.state = state;
    sessions_.push_back(record);
  }
  static json answers() {
    json all = json::object();
    for (const auto& item : default_rating_form().items)
      if (item.kind == QuestionnaireItem::Kind::likert)
        all[item.id] = 4;
      else if (item.kind == QuestionnaireItem::Kind::choice)
        all[item.id] = "done";
    return all;
  }

  test::TemporaryFolder folder_;
  store::Database database_{"sqlite:" + (folder_.path() / "ream.db").string()};
  std::vector<session::SessionRecord> sessions_;
  std::shared_ptr<const StudyDependencies> server_ = std::make_shared<RatedServer>(sessions_);
  StudyService studies_{database_, server_};
  RatingService ratings_{database_, studies_, server_};
};

TEST_F(RatingServiceTest, OnlyInstructorsRateAndOnce) {
  const std::string id = made();
  EXPECT_EQ(ratings_.add(olga, id, ines.user_id).label, "R1");
  EXPECT_EQ(ratings_.add(olga, id, ivo.user_id).label, "R2");
  expect_error(ErrorKind::conflict, "already", [&] { ratings_.add(olga, id, ines.user_id); });
  expect_error(ErrorKind::conflict, "operator", [&] { ratings_.add(olga, id, olga.user_id); });
  expect_error(ErrorKind::conflict, "instructor", [&] { ratings_.add(olga, id, tom.user_id); });
  expect_error(ErrorKind::not_found, "u-nobody", [&] { ratings_.add(olga, id, "u-nobody"); });
  EXPECT_TRUE(ratings_.rates(ines, id));
  EXPECT_FALSE(ratings_.rates(olga, id));
  expect_error(ErrorKind::not_found, "do not rate", [&] { ratings_.queue(olga, id); });
  ratings_.remove(id, "R1");
  EXPECT_FALSE(ratings_.rates(ines, id));
  studies_.close(id);
  expect_error(ErrorKind::conflict, "closed", [&] { ratings_.add(olga, id, ines.user_id); });
  expect_error(ErrorKind::conflict, "closed", [&] { ratings_.remove(id, "R2"); });
  expect_error(ErrorKind::conflict, "raters", [&] { studies_.reopen(id); });
}

TEST_F(RatingServiceTest, EachRaterHasKeysAndAnOrderOfTheirOwn) {
  const std::string id = made(), code = participant(id, tom);
  for (char letter = 'a'; letter <= 'l'; ++letter) add_session(id, code, std::string("s") + letter);
  ratings_.add(olga, id, ines.user_id);
  ratings_.add(olga, id, ivo.user_id);
  const auto first = ratings_.queue(ines, id), second = ratings_.queue(ivo, id);
  ASSERT_EQ(first.size(), 12u);
  ASSERT_EQ(second.size(), 12u);
  std::set<std::string> keys;
  std::vector<std::string> order, other;
  for (const auto& one : first) keys.insert(one.key), order.push_back(one.session);
  for (const auto& one : second) keys.insert(one.key), other.push_back(one.session);
  EXPECT_EQ(keys.size(), 24u) << "what one rater sees says nothing to another";
  EXPECT_NE(order, other);
  EXPECT_FALSE(std::is_sorted(order.begin(), order.end())) << "one of 12! orders";
  // Another session comes in: what was named before keeps its name.
  add_session(id, code, "sm");
  std::set<std::string> now;
  for (const auto& one : ratings_.queue(ines, id)) now.insert(one.key);
  for (const auto& one : first) EXPECT_TRUE(now.contains(one.key));
}

TEST_F(RatingServiceTest, WhatIsRatedWasCarriedOutByAnotherAndIsStillKnown) {
  const std::string id = made(), code = participant(id, tom);
  add_session(id, code, "sa");
  add_session(id, code, "sb", "", "2026-03-01T08:00:00Z", SessionState::fault);
  add_session(id, code, "sc");
  sessions_.back().request.followed_by = "sd";
  add_session(id, code, "sd");
  sessions_.back().request.trainee_id = ines.user_id;
  add_session(id, "NO-ONE", "se");
  add_session(id, code, "air2");
  ratings_.add(olga, id, ines.user_id);
  ASSERT_EQ(ratings_.queue(ines, id).size(), 1u);
  EXPECT_EQ(ratings_.queue(ines, id)[0].session, "sa");
  const std::string designed = made(control_and_trained()), other = participant(designed, tom);
  for (const char* phase : {"pre", "training", "post", "retention", ""})
    add_session(designed, other, "t" + std::string(phase), phase);
  ratings_.add(olga, designed, ines.user_id);
  EXPECT_EQ(ratings_.queue(ines, designed).size(), 3u) << "tests only";
}

TEST_F(RatingServiceTest, RatingsAreKeptUntilTheStudyIsClosed) {
  const std::string id = made(), code = participant(id, tom);
  add_session(id, code, "sa");
  ratings_.add(olga, id, ines.user_id);
  const std::string key = ratings_.queue(ines, id)[0].key;
  EXPECT_FALSE(ratings_.queued(ines, id, key).answers);
  json incomplete = answers();
  incomplete.erase("steady_pressure");
  EXPECT_THROW(ratings_.rate(ines, id, key, incomplete), net::RequestError);
  json rating = answers();
  ratings_.rate(ines, id, key, rating);
  rating["respect_for_bone"] = 2;
  ratings_.rate(ines, id, key, rating);
  EXPECT_EQ(ratings_.queued(ines, id, key).answers, rating);
  EXPECT_EQ(ratings_.raters(olga, id).at(0).rated, 1);
  EXPECT_EQ(ratings_.raters(olga, id).at(0).to_rate, 1);
  expect_error(ErrorKind::not_found, "queue", [&] { ratings_.rate(ines, id, "0123456789abcdef", rating); });
  const StudyExport all = studies_.export_all(olga, id);
  ASSERT_EQ(all.ratings.rows.size(), 1u);
  const std::string csv = session::csv_of(all.ratings);
  EXPECT_NE(csv.find(code + ",novice,1,,,R1,2,4,"), std::string::npos) << csv;
  EXPECT_EQ(csv.find("Ines"), std::string::npos);
  studies_.close(id);
  expect_error(ErrorKind::conflict, "closed", [&] { ratings_.rate(ines, id, key, rating); });
}

TEST_F(RatingServiceTest, SessionsAreHiddenFromTheirRatersWhileTheStudyIsOpen) {
  const std::string id = made(), code = participant(id, tom);
  add_session(id, code, "sa");
  session::SessionRequest session = sessions_.back().request;
  EXPECT_FALSE(ratings_.hides(ines, session));
  ratings_.add(olga, id, ines.user_id);
  EXPECT_TRUE(ratings_.hides(ines, session));
  EXPECT_FALSE(ratings_.hides(ivo, session));
  EXPECT_FALSE(ratings_.hides(olga, session));
  EXPECT_FALSE(ratings_.hides({"", "", "operator", "", ""}, session)) << "a server without users";
  session.trainee_id = ines.user_id;
  EXPECT_FALSE(ratings_.hides(ines, session)) << "one's own";
  session.trainee_id.clear();
  studies_.close(id);
  EXPECT_FALSE(ratings_.hides(ines, session));
}

TEST_F(RatingServiceTest, ParticipantsComeToArmsByThePublishedSequence) {
  const std::string id = made(control_and_trained());
  std::map<std::string, int> arms;
  std::vector<std::string> codes;
  for (int i = 0; i < 8; ++i) codes.push_back(studies_.enrol(ines, id, {"novice", 0, "", "", ""}).code);
  studies_.withdraw(id, codes[2]);
  for (int i = 0; i < 4; ++i) codes.push_back(studies_.enrol(ines, id, {"novice", 0, "", "", ""}).code);
  for (const Participant& one : studies_.participants(ines, id))
    EXPECT_EQ(one.arm, "") << "hidden while open";
  EXPECT_EQ(studies_.get(olga, id).allocation_seed.size(), 64u);
  const std::string seed = studies_.get(olga, id).allocation_seed;
  for (size_t place = 0; place < codes.size(); ++place) {
    if (place == 2) continue;
    const Participant one = studies_.participant(olga, id, codes[place]);
    EXPECT_EQ(one.arm, arm_at(control_and_trained(), seed, "novice", static_cast<int64_t>(place)).id)
        << place;
    ++arms[one.arm];
  }
  EXPECT_EQ(arms["control"] + arms["trained"], 11);
  EXPECT_LE(std::abs(arms["control"] - arms["trained"]), 4) << "blocks of six at most, and one who withdrew";
  EXPECT_EQ(studies_.enrol(ines, id, {"novice", 0, "", "", ""}).arm, "");
  EXPECT_NE(studies_.enrol(olga, id, {"novice", 0, "", "", ""}).arm, "");
  EXPECT_EQ(studies_.join(tom, {"novice", 0, "", "", studies_.get(olga, id).join_code}).second.arm, "");
  studies_.close(id);
  EXPECT_NE(studies_.participants(ines, id)[0].arm, "");
}

TEST_F(RatingServiceTest, ASessionIsWhatItsParticipantDoesNext) {
  const std::string id = made(control_and_trained());
  std::string code;
  for (int i = 0; i < 8 && code.empty(); ++i) {
    const std::string drawn = studies_.enrol(ines, id, {"novice", 0, "", "", ""}).code;
    if (studies_.participant(olga, id, drawn).arm == "trained") code = drawn;
  }
  ASSERT_NE(code, "");
  const auto admitted = [&](const std::string& case_id = {}) {
    session::SessionRequest wanted;
    wanted.study = id;
    wanted.participant = code;
    wanted.case_id = case_id;
    wanted.theatre = true;
    studies_.admit(ines, wanted);
    return wanted;
  };
  EXPECT_EQ(admitted().phase, "pre");
  RatedServer::live = code;
  expect_error(ErrorKind::conflict, "has not ended", [&] { admitted(); });
  RatedServer::live.clear();
  EXPECT_EQ(admitted().case_id, "demo");
  EXPECT_FALSE(admitted().theatre) << "tests are alike for all";
  expect_error(ErrorKind::conflict, "tested next, on case 'demo'", [&] { admitted("hard"); });
  add_session(id, code, "air1", "pre");
  EXPECT_EQ(admitted().phase, "pre") << "who never touched bone was not tested";
  add_session(id, code, "p1", "pre", "2026-03-01T08:00:00Z", SessionState::fault);
  EXPECT_EQ(admitted().phase, "pre");
  add_session(id, code, "p2", "pre");
  EXPECT_EQ(admitted("hard").phase, "training");
  EXPECT_EQ(admitted().script, "quiet");
  EXPECT_TRUE(admitted().theatre);
  add_session(id, code, "t1", "training");
  const session::SessionRequest trained = sessions_.back().request;
  EXPECT_NO_THROW(studies_.require_repeatable(trained));
  expect_error(ErrorKind::conflict, "done once", [&] {
    session::SessionRequest test = trained;
    test.phase = "pre";
    studies_.require_repeatable(test);
  });
  add_session(id, code, "t2", "training");
  EXPECT_EQ(admitted().phase, "post");
  expect_error(ErrorKind::conflict, "all training", [&] { studies_.require_repeatable(trained); });
  EXPECT_EQ(admitted().script, "");
  const std::string today = utc_now();
  add_session(id, code, "q1", "post", today);
  expect_error(ErrorKind::conflict, date_text(day_of(today) + 14), [&] { admitted(); });
  sessions_.back().request.created_utc = "2026-03-02T08:00:00Z";
  EXPECT_EQ(admitted().phase, "retention");
  add_session(id, code, "r1", "retention", today);
  expect_error(ErrorKind::conflict, "every session", [&] { admitted(); });
}

TEST_F(RatingServiceTest, WhoRatesRunsNoSessions) {
  const std::string id = made(), code = participant(id, tom);
  ratings_.add(olga, id, ines.user_id);
  session::SessionRequest wanted;
  wanted.study = id;
  wanted.participant = code;
  expect_error(ErrorKind::conflict, "you rate", [&] { studies_.admit(ines, wanted); });
  expect_error(ErrorKind::conflict, "you rate", [&] { studies_.enrol(ines, id, {"expert", 9, "", "", ""}); });
  EXPECT_NO_THROW(studies_.admit(ivo, wanted));
  EXPECT_EQ(studies_.rated_by(ines), std::vector<std::string>{id});
  studies_.close(id);
  EXPECT_TRUE(studies_.rated_by(ines).empty());
}

TEST_F(RatingServiceTest, KeysTellNothingWithoutTheStudysKey) {
  const std::string id = made(), code = participant(id, tom);
  add_session(id, code, "sa");
  ratings_.add(olga, id, ines.user_id);
  const Study study = studies_.get(olga, id);
  EXPECT_EQ(study.rating_key.size(), 64u);
  EXPECT_NE(study.rating_key, study.allocation_seed);
  EXPECT_EQ(ratings_.queue(ines, id)[0].key, access::keyed_digest(study.rating_key, "R1/sa"));
  EXPECT_NE(access::keyed_digest(study.rating_key, "R1/sa"),
            access::keyed_digest(study.allocation_seed, "R1/sa"));
  EXPECT_NE(access::random_key(), access::random_key());
}

TEST_F(RatingServiceTest, TheTestCaseIsOneOfTheStudys) {
  StudyDesign design = control_and_trained();
  design.test_case = "other";
  expect_error(ErrorKind::invalid_input, "other", [&] { made(design); });
}

}  // namespace
}  // namespace ream::study
