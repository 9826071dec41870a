#include "study/study_export.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "score/metric_catalogue.hpp"
#include "statistics/sample.hpp"
#include "study/study_columns.hpp"
#include "support/seed.hpp"

namespace ream::study {
namespace {

using nlohmann::json;
using statistics::quantile;

Study study() {
  Study made;
  made.id = "s1";
  made.name = "First year";
  made.questionnaire = questionnaire_from(json::parse(R"({"id": "q_1", "title": "Q", "items": [
      {"id": "force", "kind": "likert", "words": "The force is real.", "points": 5, "cannot_judge": true},
      {"id": "hand", "kind": "choice", "words": "Which hand?", "required": false,
       "options": [{"id": "left", "words": "Left"}, {"id": "right", "words": "Right"}]},
      {"id": "tools", "kind": "choice", "words": "Which tools?", "several": true,
       "options": [{"id": "saw", "words": "Saw"}, {"id": "drill", "words": "Drill"}]},
      {"id": "remarks", "kind": "text", "words": "Anything else?"}]})"));
  return made;
}

std::vector<Participant> participants() {
  return {{"K7-F3M", "novice", 0, json{{"force", nullptr}, {"tools", {"saw", "drill"}}, {"remarks", "=1+1"}}},
          {"B2-C4D", "expert", 250,
           json{{"force", 4}, {"hand", "left"}, {"tools", {"saw"}}, {"remarks", "good, \"real\"\nfeel"}}},
          {"Z9-XYZ", "novice", 3, std::nullopt, false}};
}

/// Its id says how deep it went.
session::SessionRecord attempt(const std::string& code, const std::string& utc, const std::string& state,
                               double depth_mm, bool given_up = false) {
  session::SessionRecord record;
  record.request.id = std::to_string(depth_mm);
  record.request.participant = code;
  record.request.case_id = "demo";
  record.request.script = "practice";
  record.request.created_utc = utc;
  if (given_up) record.request.followed_by = "the next";
  record.status.state = session_state_from(state).value();
  record.status.device = {"browser", "touch", "", {}};
  return record;
}

json metrics(const std::string& session_id) {
  const double depth_mm = std::stod(session_id);
  return {{"reaming_depth_mm", depth_mm},
          {"axial_thrust_mean_n", 40.25},
          {"apparent_stiffness_n_mm", nullptr},
          {"session_hash", "0123456789abcdef"},
          {"grid_hash", "0123456789abcdef"},
          {"score", {{"points", depth_mm * 10}, {"passed", depth_mm > 1.0}, {"name", "first year"}}}};
}

std::vector<session::SessionRecord> attempts() {
  return {attempt("K7-F3M", "2026-03-02T00:10:00Z", "finished", 2.0),
          attempt("K7-F3M", "2026-02-27T23:50:00Z", "stopped", 1.0),
          attempt("B2-C4D", "2026-02-28T09:00:00Z", "finished", 3.0),
          attempt("K7-F3M", "2026-03-01T08:00:00Z", "fault", 9.0),
          attempt("Z9-XYZ", "2026-03-01T08:00:00Z", "stopped", 4.0),
          attempt("Z9-XYZ", "2026-03-01T07:00:00Z", "stopped", 8.0, true),
          attempt("NO-ONE", "2026-03-01T08:00:00Z", "finished", 5.0)};
}

TEST(StudyExport, SessionsAreByParticipantAndAttemptWithoutDates) {
  EXPECT_EQ(
      session::csv_of(export_of(study(), participants(), attempts(), metrics).sessions),
      "study,participant,experience,procedures_done,attempt,study_day,case,script,device,device_profile,"
      "state,given_up,axial_thrust_mean_n,reaming_depth_mm,score.passed,score.points\r\n"
      "s1,B2-C4D,expert,250,1,1,demo,practice,browser,touch,finished,0,40.25,3.0,1,30.0\r\n"
      "s1,K7-F3M,novice,0,1,1,demo,practice,browser,touch,stopped,0,40.25,1.0,0,10.0\r\n"
      "s1,K7-F3M,novice,0,2,3,demo,practice,browser,touch,fault,0,40.25,9.0,1,90.0\r\n"
      "s1,K7-F3M,novice,0,3,4,demo,practice,browser,touch,finished,0,40.25,2.0,1,20.0\r\n"
      "s1,Z9-XYZ,novice,3,1,1,demo,practice,browser,touch,stopped,1,40.25,8.0,1,80.0\r\n"
      "s1,Z9-XYZ,novice,3,2,1,demo,practice,browser,touch,stopped,0,40.25,4.0,1,40.0\r\n");
}

TEST(StudyExport, AnswersAreByParticipantAndSafeForSpreadsheets) {
  EXPECT_EQ(session::csv_of(export_of(study(), participants(), attempts(), metrics).answers),
            "study,participant,experience,procedures_done,answered,force,hand,tools,remarks\r\n"
            "s1,B2-C4D,expert,250,1,4,left,saw,\"good, \"\"real\"\"\nfeel\"\r\n"
            "s1,K7-F3M,novice,0,1,,,saw;drill,'=1+1\r\n"
            "s1,Z9-XYZ,novice,3,0,,,,\r\n");
}

TEST(StudyExport, InJsonCannotJudgeIsToldApartFromNoAnswer) {
  const json answers = session::json_of(export_of(study(), participants(), attempts(), metrics).answers);
  EXPECT_TRUE(answers[1].at("force").is_null());
  EXPECT_FALSE(answers[1].contains("hand"));
  EXPECT_EQ(answers[1].at("remarks"), "=1+1");
  EXPECT_FALSE(answers[2].contains("force"));
  EXPECT_EQ(answers[2].at("answered"), false);
}

/// Of K7-F3M the median of 1 and 2 counts (a fault does not), of Z9-XYZ 4 (what was given up does not).
TEST(StudyExport, GroupsCountEachParticipantOnce) {
  EXPECT_EQ(session::csv_of(export_of(study(), participants(), attempts(), metrics).groups),
            "study,experience,kind,name,n,median,quartile_1,quartile_3\r\n"
            "s1,novice,metric,axial_thrust_mean_n,2,40.25,40.25,40.25\r\n"
            "s1,novice,metric,reaming_depth_mm,2,2.75,2.125,3.375\r\n"
            "s1,novice,metric,score.passed,2,0.75,0.625,0.875\r\n"
            "s1,novice,metric,score.points,2,27.5,21.25,33.75\r\n"
            "s1,expert,metric,axial_thrust_mean_n,1,40.25,40.25,40.25\r\n"
            "s1,expert,metric,reaming_depth_mm,1,3.0,3.0,3.0\r\n"
            "s1,expert,metric,score.passed,1,1.0,1.0,1.0\r\n"
            "s1,expert,metric,score.points,1,30.0,30.0,30.0\r\n"
            "s1,expert,answer,force,1,4.0,4.0,4.0\r\n");
}

TEST(StudyExport, QuartilesAreThoseOfR) {
  const std::vector<double> seven = {1, 2, 3, 4, 5, 6, 10};
  EXPECT_DOUBLE_EQ(quantile(seven, 0.25), 2.5);
  EXPECT_DOUBLE_EQ(quantile(seven, 0.5), 4.0);
  EXPECT_DOUBLE_EQ(quantile(seven, 0.75), 5.5);
  EXPECT_DOUBLE_EQ(quantile({1, 2, 3, 4}, 0.25), 1.75);
  EXPECT_DOUBLE_EQ(quantile({3}, 0.75), 3.0);
}

TEST(StudyExport, TheCodebookExplainsEveryColumnWithItsUnit) {
  const StudyExport all = export_of(study(), participants(), attempts(), metrics);
  const json codebook = codebook_of(study(), all);
  EXPECT_EQ(codebook.at("questionnaire"), "q_1");
  for (const session::ExportTable* table : {&all.sessions, &all.answers, &all.groups}) {
    const json& columns = codebook.at(table->name);
    ASSERT_EQ(columns.size(), table->columns.size());
    for (size_t i = 0; i < columns.size(); ++i) {
      EXPECT_EQ(columns[i].at("name"), table->columns[i].name);
      EXPECT_FALSE(columns[i].at("words").get<std::string>().empty()) << columns[i];
      for (const auto& row : table->rows) EXPECT_EQ(row.size(), columns.size());
    }
  }
  const auto unit = [&](const std::string& name) {
    for (const json& column : codebook.at("sessions"))
      if (column.at("name") == name) return column.at("unit");
    return json("no such column");
  };
  EXPECT_EQ(unit("reaming_depth_mm"), "mm");
  EXPECT_EQ(unit("axial_thrust_mean_n"), "N");
  EXPECT_TRUE(unit("case").is_null());
}

TEST(StudyExport, MetricsAreExplainedAsTheCatalogueDoes) {
  for (const score::Metric& metric : score::metric_catalogue()) {
    const session::ExportColumn column = metric_column(std::string(metric.key));
    EXPECT_EQ(column.unit, metric.unit) << metric.key;
    EXPECT_NE(column.words.find(metric.definition), std::string::npos) << column.words;
  }
  EXPECT_EQ(metric_column("axial_thrust_excess_n_s").unit, "N s");
}

TEST(StudyExport, AnEmptyStudyHasHeadingsOnly) {
  Study asks_nothing = study();
  asks_nothing.questionnaire.reset();
  const StudyExport all = export_of(asks_nothing, {}, {}, metrics);
  EXPECT_TRUE(all.sessions.rows.empty());
  EXPECT_TRUE(session::json_of(all.groups).empty());
  EXPECT_EQ(session::csv_of(all.answers), "study,participant,experience,procedures_done,answered\r\n");
}

/// In whatever order sessions were found, the export is the same: it says nothing about who came when.
TEST(StudyExport, DoesNotDependOnTheOrderOfWhatItIsMadeOf) {
  std::mt19937 random(test::seed());
  const StudyExport first = export_of(study(), participants(), attempts(), metrics);
  for (int turn = 0; turn < 50; ++turn) {
    auto people = participants();
    auto sessions = attempts();
    std::shuffle(people.begin(), people.end(), random);
    std::shuffle(sessions.begin(), sessions.end(), random);
    const StudyExport again = export_of(study(), people, sessions, metrics);
    EXPECT_EQ(session::csv_of(again.sessions), session::csv_of(first.sessions));
    EXPECT_EQ(session::csv_of(again.answers), session::csv_of(first.answers));
    EXPECT_EQ(session::csv_of(again.groups), session::csv_of(first.groups));
  }
}

}  // namespace
}  // namespace ream::study
