#include "study/validity_input.hpp"

#include <gtest/gtest.h>

namespace ream::study {
namespace {

using nlohmann::json;

Study rated_study() {
  Study made;
  made.id = "s1";
  made.settings.rating_form = questionnaire_from(json::parse(R"({"id": "form", "title": "F", "items": [
      {"id": "flow", "kind": "likert", "words": "Flow", "points": 5, "cannot_judge": true},
      {"id": "seven", "kind": "likert", "words": "Of seven", "points": 7},
      {"id": "steady", "kind": "choice", "words": "Steady",
       "options": [{"id": "yes", "words": "Yes"}, {"id": "no", "words": "No"}]},
      {"id": "hand", "kind": "choice", "words": "Which hand?",
       "options": [{"id": "l", "words": "L"}, {"id": "r", "words": "R"}, {"id": "b", "words": "B"}]},
      {"id": "remarks", "kind": "text", "words": "Anything else?"}]})"));
  return made;
}

session::SessionRecord ended(const std::string& id, const std::string& code, const std::string& utc,
                             SessionState state = SessionState::finished) {
  session::SessionRecord record;
  record.request.id = id;
  record.request.participant = code;
  record.request.created_utc = utc;
  record.request.phase = "post";
  record.status.state = state;
  record.mark = session::SessionMark{};
  record.mark->points = 71.5;
  return record;
}

json metrics_of(const std::string& id) {
  return {{"contact_time_s", id == "air" ? 0.0 : 4.0},
          {"reaming_depth_mm", 1.25},
          {"depth_planned_mm", 1.0},
          {"version_error_deg", nullptr},
          {"session_hash", "0123456789abcdef"},
          {"timing_us", 80.0}};
}

TEST(ValidityInput, HoldsWhatWasCarriedOutOnBoneUnderCodes) {
  const std::vector<Participant> participants = {{"K7-F3M", "novice", 0, std::nullopt, false, "control"}};
  const std::vector<session::SessionRecord> sessions = {
      ended("bb", "K7-F3M", "2026-03-02T08:00:00Z"), ended("aa", "K7-F3M", "2026-03-01T08:00:00Z"),
      ended("cc", "K7-F3M", "2026-03-03T08:00:00Z", SessionState::fault),
      ended("air", "K7-F3M", "2026-03-04T08:00:00Z"), ended("dd", "NO-ONE", "2026-03-04T08:00:00Z")};
  const ValidityInput input = validity_input_of(rated_study(), participants, sessions, metrics_of, {});
  ASSERT_EQ(input.sessions.size(), 2u);
  EXPECT_EQ(input.sessions[0].session, "K7-F3M-1");
  EXPECT_EQ(input.sessions[1].session, "K7-F3M-2");
  EXPECT_EQ(input.sessions[1].attempt, 2);
  EXPECT_EQ(input.sessions[0].experience, "novice");
  EXPECT_EQ(input.sessions[0].arm, "control");
  EXPECT_EQ(input.sessions[0].phase, "post");
  EXPECT_EQ(
      input.sessions[0].measures,
      (std::map<std::string, double>{{"contact_time_s", 4.0}, {"points", 71.5}, {"reaming_depth_mm", 1.25}}))
      << "what the plan fixes and what the catalogue does not know is no measure";
}

TEST(ValidityInput, ScalesOfFiveAndChoicesBetweenTwoAreNumbers) {
  const std::vector<Participant> participants = {{"K7-F3M", "expert", 0, std::nullopt}};
  const std::vector<session::SessionRecord> sessions = {ended("aa", "K7-F3M", "2026-03-01T08:00:00Z")};
  const json first = {{"flow", 4}, {"seven", 7}, {"steady", "no"}, {"hand", "l"}, {"remarks", "good"}};
  const json second = {{"flow", nullptr}, {"seven", 1}, {"steady", "yes"}, {"hand", "r"}};
  const ValidityInput input =
      validity_input_of(rated_study(), participants, sessions, metrics_of,
                        {{"R1", "aa", first}, {"R2", "aa", second}, {"R1", "gone", first}});
  ASSERT_EQ(input.items.size(), 2u);
  EXPECT_EQ(input.items[0].id, "flow");
  EXPECT_EQ(input.items[0].kind, ItemKind::scale);
  EXPECT_EQ(input.items[1].id, "steady");
  EXPECT_EQ(input.items[1].kind, ItemKind::check);
  std::string said;
  for (const Rating& one : input.ratings)
    said += one.rater + " " + one.session + " " + one.item + " " +
            std::to_string(static_cast<int>(one.value)) + "\n";
  EXPECT_EQ(said, "R1 K7-F3M-1 flow 4\nR1 K7-F3M-1 steady 0\nR2 K7-F3M-1 steady 1\n");
  EXPECT_NO_THROW(validity_report(input)) << "one participant gives sentences, not errors";
}

TEST(ValidityInput, ATestBeyondThoseOfTheDesignIsLeftOut) {
  Study study = rated_study();
  study.settings.design = StudyDesign{};
  study.settings.design->arms = {{"all", "All", 3, false, "", ""}};
  const std::vector<Participant> participants = {{"K7-F3M", "novice", 0, std::nullopt, false, "all"}};
  const std::vector<session::SessionRecord> sessions = {ended("bb", "K7-F3M", "2026-03-02T08:00:00Z"),
                                                        ended("aa", "K7-F3M", "2026-03-01T08:00:00Z")};
  const ValidityInput input = validity_input_of(study, participants, sessions, metrics_of, {});
  ASSERT_EQ(input.sessions.size(), 1u);
  EXPECT_EQ(input.sessions[0].session, "K7-F3M-1") << "the first counts";
}

TEST(ValidityInput, PointsByDifferentRubricsAreNotCompared) {
  const std::vector<Participant> participants = {{"K7-F3M", "novice", 0, std::nullopt}};
  std::vector<session::SessionRecord> sessions = {ended("aa", "K7-F3M", "2026-03-01T08:00:00Z"),
                                                  ended("bb", "K7-F3M", "2026-03-02T08:00:00Z")};
  sessions[1].mark->version = sessions[0].mark->version + 1;
  for (const RatedSession& one :
       validity_input_of(rated_study(), participants, sessions, metrics_of, {}).sessions)
    EXPECT_FALSE(one.measures.contains("points"));
}

TEST(ValidityInput, AnswersThatDoNotFitTheFormAreMissing) {
  const std::vector<Participant> participants = {{"K7-F3M", "novice", 0, std::nullopt}};
  const std::vector<session::SessionRecord> sessions = {ended("aa", "K7-F3M", "2026-03-01T08:00:00Z")};
  const json older = {{"flow", "good"}, {"steady", 3}};
  const ValidityInput input =
      validity_input_of(rated_study(), participants, sessions, metrics_of, {{"R1", "aa", older}});
  ASSERT_EQ(input.ratings.size(), 1u);
  EXPECT_EQ(input.ratings[0].value, 0.0) << "not what counts as done";
}

TEST(ValidityInput, TheScriptForRIsThere) { EXPECT_EQ(validity_script().substr(0, 14), "#!/usr/bin/env"); }

}  // namespace
}  // namespace ream::study
