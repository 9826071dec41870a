#include "study/feel_service.hpp"

#include <gtest/gtest.h>

#include "core/new_id.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace ream::study {
namespace {

using nlohmann::json;
using test::expect_error;

const net::Caller organiser{"u-olga", "Olga", "operator", "", ""};
const net::Caller teacher{"u-ines", "Ines", "instructor", "", ""};
const net::Caller surgeon{"u-tom", "Tom", "trainee", "", ""};
const net::Caller outsider{"u-ben", "Ben", "trainee", "", ""};

class FeltServer final : public StudyDependencies {
 public:
  std::optional<StudyUser> find_user(const std::string&) const override { return std::nullopt; }
  bool has_case(const std::string&) const override { return true; }
  bool has_live_session(const std::string&, const std::string&) const override { return live; }
  std::vector<session::SessionRecord> sessions(const std::string&) const override { return ended; }
  json metrics(const std::string& session) const override {
    return {{"contact_time_s", session.starts_with("air") ? 0.0 : 4.5},
            {"contact_spread_mm", session.starts_with("one") ? 4.0 : 38.0}};
  }
  std::vector<session::SessionRecord> ended;
  bool live = false;
};

class FeelServiceTest : public testing::Test {
 protected:
  FeelServiceTest() {
    StudyDraft draft;
    draft.name = "Feel";
    draft.settings.feel = FeelTrials{{"cartilage", "density"}, 2};
    draft.settings.device = "browser";
    study_ = studies_.create(draft).id;
    code_ = studies_.join(surgeon, {"expert", 100, "", "", studies_.get(organiser, study_).join_code})
                .second.code;
  }
  session::SessionRequest wanted() {
    session::SessionRequest request;
    request.study = study_;
    studies_.admit(surgeon, request);
    return request;
  }
  /// A session that was begun and ended.
  void feel(const std::string& id, SessionState state = SessionState::stopped) {
    session::SessionRecord record;
    record.request = wanted();
    record.request.id = id;
    record.request.created_utc = utc_now_in_order();
    record.status.state = state;
    server_->ended.push_back(record);
  }
  FeelPlace answer(int number, const std::string& chosen = "upper") {
    return feel_.answer(surgeon, study_, code_, number, chosen);
  }

  test::TemporaryFolder folder_;
  store::Database database_{"sqlite:" + (folder_.path() / "ream.db").string()};
  std::shared_ptr<FeltServer> server_ = std::make_shared<FeltServer>();
  StudyService studies_{database_, server_};
  FeelService feel_{database_, studies_, server_};
  std::string study_, code_;
};

TEST_F(FeelServiceTest, PlatesAreTheServersAndNothingButBoneIsShown) {
  const session::SessionRequest request = wanted();
  EXPECT_TRUE(case_::is_two_plates(request.case_id));
  EXPECT_EQ(request.phase, feel_phase);
  EXPECT_TRUE(request.theatre);
  EXPECT_EQ(request.participant, code_);
  session::SessionRequest chosen;
  chosen.study = study_;
  chosen.case_id = "demo";
  expect_error(ErrorKind::conflict, "chosen by the server", [&] { studies_.admit(surgeon, chosen); });
  server_->live = true;
  expect_error(ErrorKind::conflict, "not ended", [&] { wanted(); });
}

TEST_F(FeelServiceTest, FirstFeelThenAnswerOnceAndInOrder) {
  EXPECT_EQ(feel_.place(surgeon, study_, code_).session, "");
  expect_error(ErrorKind::conflict, "feel both plates", [&] { answer(1); });
  feel("one1");
  feel("broken", SessionState::interrupted);
  expect_error(ErrorKind::conflict, "feel both plates", [&] { answer(1); });
  feel("s1");
  feel("s2");
  EXPECT_EQ(feel_.place(surgeon, study_, code_).session, "s2");
  expect_error(ErrorKind::conflict, "not the next", [&] { answer(2); });
  server_->live = true;
  expect_error(ErrorKind::conflict, "end the session", [&] { answer(1); });
  server_->live = false;
  FeelPlace place = answer(1);
  EXPECT_EQ(place.trial->number, 2);
  EXPECT_EQ(place.session, "") << "the earlier sessions were for the first trial, whatever its plates";
  expect_error(ErrorKind::conflict, "not the next", [&] { answer(1); });
  for (int number = 2; number <= 4; ++number) {
    feel("t" + std::to_string(number));
    place = answer(number, "lower");
  }
  EXPECT_FALSE(place.trial);
  expect_error(ErrorKind::conflict, "every trial", [&] { wanted(); });
  expect_error(ErrorKind::conflict, "not the next", [&] { answer(5); });
  EXPECT_EQ(feel_.report(organiser, study_).participants, 1u);
  // Each plate was asked for twice; upper was chosen once.
  EXPECT_EQ(feel_.answers(organiser, study_).rows.size(), 4u);
}

TEST_F(FeelServiceTest, OthersNeitherAnswerNorLearnWhatWasRight) {
  feel("s1");
  expect_error(ErrorKind::not_found, "no study", [&] { feel_.place(outsider, study_, code_); });
  EXPECT_THROW(feel_.answer(teacher, study_, code_, 1, "upper"), net::RequestError);
  EXPECT_EQ(feel_.place(teacher, study_, code_).trial->number, 1);
  expect_error(ErrorKind::conflict, "close it first", [&] { feel_.report(teacher, study_); });
  const session::SessionRequest felt = server_->ended[0].request;
  EXPECT_TRUE(feel_.hides(surgeon, felt));
  EXPECT_TRUE(feel_.hides(teacher, felt));
  EXPECT_FALSE(feel_.hides(organiser, felt));
  studies_.close(study_);
  expect_error(ErrorKind::conflict, "closed", [&] { answer(1); });
  EXPECT_FALSE(feel_.hides(surgeon, felt));
  EXPECT_EQ(feel_.report(teacher, study_).lines.size(), 2u);
  expect_error(ErrorKind::conflict, "trials of feel", [&] { studies_.reopen(study_); });
  expect_error(ErrorKind::conflict, "closed", [&] {
    store::FeelTable(database_).add(study_, {code_, 1, "upper", "s1", "2026-03-01T08:00:00.000Z"});
  });
}

TEST_F(FeelServiceTest, WhichPlatesTheyAreOnlyOperatorsSee) {
  feel("s1");
  for (const net::Caller& one : {surgeon, teacher})
    EXPECT_EQ(studies_.blinding(one).seen(server_->ended[0]).request.case_id, "two-plates");
  EXPECT_NE(studies_.blinding(organiser).seen(server_->ended[0]).request.case_id, "two-plates");
  expect_error(ErrorKind::conflict, "no skill", [&] { studies_.validity_input(organiser, study_); });
}

TEST_F(FeelServiceTest, WithAParticipantGoTheirAnswers) {
  feel("s1");
  answer(1);
  EXPECT_EQ(store::FeelTable(database_).answers(study_).size(), 1u);
  studies_.withdraw(study_, code_);
  EXPECT_TRUE(store::FeelTable(database_).answers(study_).empty());
}

TEST_F(FeelServiceTest, AStudyIsOfFeelOrHasCases) {
  StudyDraft draft;
  draft.name = "Both";
  draft.settings.feel = FeelTrials{{"cartilage"}, 2};
  expect_error(ErrorKind::invalid_input, "that a hand holds", [&] { studies_.create(draft); });
  draft.settings.device = "browser";
  draft.settings.cases = {"demo"};
  expect_error(ErrorKind::invalid_input, "plates of its own", [&] { studies_.create(draft); });
  draft.settings.feel.reset();
  const std::string plain = studies_.create(draft).id;
  expect_error(ErrorKind::conflict, "no study of feel", [&] { feel_.place(teacher, plain, "x"); });
  draft.settings.cases.clear();
  expect_error(ErrorKind::invalid_input, "one or more", [&] { studies_.create(draft); });
}

}  // namespace
}  // namespace ream::study
