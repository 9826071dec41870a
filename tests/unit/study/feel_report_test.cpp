#include "study/feel_report.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace ream::study {
namespace {

/// A study of one comparison, and answers of persons who are right so often.
struct Felt {
  Study study;
  std::vector<Participant> participants;
  std::vector<store::FeelAnswerRow> answers;

  Felt() {
    study.allocation_seed = "seed";
    study.settings.feel = FeelTrials{{"cartilage"}, 8};
  }
  void add(const std::string& code, int right, int answered = 8) {
    participants.push_back({code, "expert", 100, std::nullopt, false, ""});
    for (const FeelTrial& trial : trials_for(*study.settings.feel, study.allocation_seed, code)) {
      if (trial.number > answered) break;
      const bool is_right = trial.number <= right;
      const bool upper = trial.asked_for_is_upper == is_right;
      answers.push_back({code, trial.number, upper ? "upper" : "lower", "s" + std::to_string(trial.number),
                         "2026-03-01T08:00:00Z"});
    }
  }
  FeelLine line() const { return feel_report(study, participants, answers).lines.at(0); }
};

TEST(FeelReport, SharesAreOfPersonsWithTheirInterval) {
  Felt felt;
  felt.add("A", 6);
  felt.add("B", 7);
  felt.add("C", 8);
  const FeelLine line = felt.line();
  EXPECT_EQ(line.persons, 3u);
  EXPECT_EQ(line.answers, 24u);
  // Shares 0.75, 0.875 and 1: by hand. Student's t of 2 degrees of freedom has p = 1 - t / sqrt(2 + t^2).
  EXPECT_DOUBLE_EQ(*line.right, 0.875);
  EXPECT_DOUBLE_EQ(*line.sd, 0.125);
  const double t = 0.375 / (0.125 / std::sqrt(3.0));
  EXPECT_NEAR(*line.chance_p, 1.0 - t / std::sqrt(2.0 + t * t), 1e-12);
  EXPECT_NEAR(line.interval->low, 0.875 - 4.302653 * 0.125 / std::sqrt(3.0), 1e-6);
  EXPECT_EQ(line.interval->high, 1.0) << "cut off";
  EXPECT_NEAR(*line.d_prime, 1.414214 * 1.150349, 1e-5);
  EXPECT_NEAR(line.published->share, 0.69, 1e-12);
}

TEST(FeelReport, WhoHasNotAnsweredAllIsLeftOutAndTooFewAreSaid) {
  Felt felt;
  felt.add("A", 6);
  felt.add("B", 7);
  felt.add("C", 4, 7);
  const FeelLine line = felt.line();
  EXPECT_EQ(line.persons, 2u);
  EXPECT_FALSE(line.right);
  EXPECT_NE(line.note.find("all trials: 2;"), std::string::npos) << line.note;
  EXPECT_EQ(feel_report(felt.study, felt.participants, felt.answers).participants, 3u);
}

TEST(FeelReport, WhereAllAreAlwaysRightThereAreExactFigures) {
  Felt felt;
  for (const char* code : {"A", "B", "C", "D", "E", "F"}) felt.add(code, 8);
  const FeelLine line = felt.line();
  EXPECT_DOUBLE_EQ(*line.right, 1.0);
  EXPECT_NEAR(*line.chance_p, 2.0 / 64.0, 1e-12) << "six of six on one side";
  EXPECT_EQ(line.interval->high, 1.0);
  EXPECT_NEAR(line.interval->low, std::pow(0.025, 1.0 / 48.0), 1e-9) << "of 48 answers, in closed form";
  EXPECT_NEAR(*line.d_prime, 1.414214 * 2.311, 2e-3) << "z(1 - 1/96)";
  EXPECT_FALSE(line.note.empty());
}

TEST(FeelReport, PsAreAdjustedForAllComparisons) {
  Felt felt;
  felt.study.settings.feel = FeelTrials{{"cartilage", "density"}, 4};
  for (const auto& [code, right] : {std::pair{"A", 8}, {"B", 7}, {"C", 6}}) felt.add(code, right);
  const FeelReport report = feel_report(felt.study, felt.participants, felt.answers);
  const double a = *report.lines[0].chance_p, b = *report.lines[1].chance_p;
  const double least = std::min(a, b), most = std::max(a, b);
  EXPECT_NEAR(*report.lines[a < b ? 0 : 1].chance_p_holm, std::min(1.0, 2.0 * least), 1e-12);
  EXPECT_NEAR(*report.lines[a < b ? 1 : 0].chance_p_holm, std::min(1.0, std::max(2.0 * least, most)), 1e-12);
}

TEST(FeelReport, AnswersOfWithdrawnParticipantsAreNotThere) {
  Felt felt;
  for (const char* code : {"A", "B", "C"}) felt.add(code, 6);
  felt.participants.pop_back();
  EXPECT_EQ(felt.line().persons, 2u);
  const session::ExportTable table = feel_answer_table(felt.study, felt.participants, felt.answers);
  EXPECT_EQ(table.rows.size(), 16u);
  int right = 0;
  for (const auto& row : table.rows) {
    ASSERT_EQ(row.size(), table.columns.size());
    EXPECT_EQ(row[5] == row[6], row[7] == 1);
    right += row[7].get<int>();
  }
  EXPECT_EQ(right, 12);
}

}  // namespace
}  // namespace ream::study
