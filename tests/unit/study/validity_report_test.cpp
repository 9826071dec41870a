#include "study/validity_report.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "study/validity_data.hpp"
#include "study/validity_sections.hpp"
#include "study/validity_tables.hpp"
#include "support/expect_error.hpp"
#include "support/seed.hpp"
#include "support/simulated_study.hpp"

namespace ream::study {
namespace {

using ream::test::expect_error;

const ValidityLine& line_of(const std::vector<ValidityLine>& lines, const std::string& measure,
                            const std::string& subject = "") {
  for (const ValidityLine& line : lines)
    if (line.measure == measure && line.subject == subject) return line;
  throw std::runtime_error("no line of " + measure + " " + subject);
}

std::optional<double> value_of(const ValidityLine& line, const std::string& name) {
  for (const auto& [key, value] : line.values)
    if (key == name) return value;
  return std::nullopt;
}

std::string notes_of(const ValidityLine& line) {
  std::string all;
  for (const std::string& note : line.notes) all += note + "\n";
  return all;
}

RatedSession plain_session(const std::string& id, const std::string& participant,
                           const std::string& experience, double value) {
  return {id, participant, experience, "", "", {{"m", value}}};
}

TEST(ValidityReport, WhoIsMeasuredTwiceIsOnePerson) {
  ValidityInput input;
  for (const auto& [person, value] : {std::pair<const char*, double>{"A", 1.0}, {"B", 2.0}, {"C", 3.0}})
    input.sessions.push_back(plain_session(std::string("s") + person, person, "novice", value));
  for (const auto& [person, value] : {std::pair<const char*, double>{"D", 4.0}, {"E", 5.0}, {"F", 9.0}}) {
    // Twice, with this mean.
    input.sessions.push_back(plain_session(std::string("s") + person, person, "expert", value - 1.0));
    input.sessions.push_back(plain_session(std::string("t") + person, person, "expert", value + 1.0));
  }
  const ValidityReport report = validity_report(input);
  const ValidityLine& line = line_of(report.known_groups, "m");
  EXPECT_EQ(value_of(line, "n_experts"), 3.0);
  EXPECT_EQ(value_of(line, "mean_experts"), 6.0);
  EXPECT_EQ(value_of(line, "mean_novices"), 2.0);
  EXPECT_EQ(value_of(line, "sd_novices"), 1.0);
  EXPECT_EQ(value_of(line, "difference"), 4.0);
  // Three and three that do not overlap: 2 of 20 orders.
  EXPECT_NEAR(*value_of(line, "mann_whitney_p"), 0.1, 1e-12);
  EXPECT_EQ(value_of(line, "auc"), 1.0);
  EXPECT_EQ(value_of(line, "threshold"), 4.0);
  EXPECT_FALSE(value_of(line, "auc_low"));
  EXPECT_NE(notes_of(line).find("do not overlap"), std::string::npos);
  EXPECT_EQ(value_of(line_of(report.benchmarks, "m"), "mean"), 6.0);
  EXPECT_NE(notes_of(line_of(report.benchmarks, "m")).find("has no interval"), std::string::npos);
}

TEST(ValidityReport, GroupsAreComparedAsTheyCame) {
  std::vector<RatedSession> sessions;
  const auto add = [&](const char* person, const char* phase, double value, int attempt) {
    sessions.push_back({"", person, "novice", "", phase, {{"m", value}}, attempt});
  };
  add("A", "training", 9.0, 3);
  add("A", "training", 1.0, 1);
  add("A", "post", 8.0, 4);
  add("B", "", 7.0, 0);  // attempt not known: after all others
  add("B", "training", 2.0, 2);
  add("C", "", 5.0, 0);
  add("C", "", 6.0, 0);
  sessions.push_back({"", "C", "novice", "", "post", {}, 1});  // first, but without a value
  const auto came = group_means(sessions, "novice", "m");
  EXPECT_EQ(came, (std::map<std::string, double>{{"A", 1.0}, {"B", 2.0}, {"C", 5.0}}));
  add("A", "pre", 3.0, 5);
  add("A", "pre", 4.0, 6);
  EXPECT_EQ(group_means(sessions, "novice", "m"), (std::map<std::string, double>{{"A", 3.5}}));
  for (RatedSession& session : sessions) session.phase.clear();
  EXPECT_EQ(group_means(sessions, "novice", "m").at("A"), 5.0);
  EXPECT_TRUE(group_means(sessions, "expert", "m").empty());
}

TEST(ValidityReport, AMeasureThatIsConstantIsNotJudged) {
  ValidityInput input;
  for (int i = 0; i < 17; ++i) {
    const std::string code = std::to_string(i);
    input.sessions.push_back(plain_session("s" + code, "P" + code, i < 3 ? "expert" : "novice", 1.87));
  }
  const ValidityReport report = validity_report(input);
  const ValidityLine& line = line_of(report.known_groups, "m");
  EXPECT_EQ(value_of(line, "mean_novices"), 1.87);
  EXPECT_EQ(value_of(line, "sd_novices"), 0.0);
  for (const char* name : {"welch_p", "difference", "cohens_d", "hedges_g", "mann_whitney_p"})
    EXPECT_FALSE(value_of(line, name)) << name;
  const ValidityLine& reached = line_of(report.benchmarks, "m");
  EXPECT_EQ(value_of(reached, "mean"), 1.87);
  EXPECT_FALSE(value_of(reached, "mean_low"));
  EXPECT_NE(notes_of(reached).find("all values are equal"), std::string::npos) << notes_of(reached);
}

TEST(ValidityReport, LearningIsThatOfLearnersWithoutTests) {
  ValidityInput input;
  const auto add = [&](const std::string& person, const char* experience, const char* phase, int attempt) {
    const double wave = attempt % 2 == 0 ? 0.05 : -0.05;
    const double value = 10.0 + 50.0 * std::exp(-0.5 * (attempt - 1)) + wave;
    const bool learns = std::string(experience) != "expert" && std::string(phase) == "training";
    input.sessions.push_back({"s" + std::to_string(input.sessions.size()),
                              person,
                              experience,
                              "",
                              phase,
                              {{"m", learns ? value : 500.0}},
                              attempt});
  };
  for (const char* person : {"A", "B", "C"}) {
    add(person, "novice", "pre", 1);
    for (int attempt = 2; attempt <= 8; ++attempt) add(person, "novice", "training", attempt);
    add(person, "novice", "post", 9);
    add(std::string("E") + person, "expert", "training", 2);
    add(std::string("E") + person, "expert", "training", 11);
  }
  add("A", "novice", "training", 10);
  const ValidityReport report = validity_report(input);
  const ValidityLine& line = line_of(report.learning, "m");
  EXPECT_EQ(value_of(line, "attempts"), 7.0);
  ASSERT_TRUE(value_of(line, "rate")) << notes_of(line);
  EXPECT_NEAR(*value_of(line, "rate"), 0.5, 0.02);
  EXPECT_NEAR(*value_of(line, "plateau"), 10.0, 0.3);
  EXPECT_NE(notes_of(line).find("fewer than 3 values are left out"), std::string::npos) << notes_of(line);
}

TEST(ValidityReport, AChecklistSaysHowManyPairsAgreeWhereKappaCannot) {
  ValidityInput input;
  input.items = {{"c", ItemKind::check}, {"d", ItemKind::check}, {"a", ItemKind::scale}};
  for (const char* id : {"s1", "s2", "s3", "s4"}) {
    input.sessions.push_back(plain_session(id, id, "novice", 1.0));
    for (const char* rater : {"R1", "R2", "R3"}) {
      input.ratings.push_back({rater, id, "c", 1});
      const bool alone = std::string(rater) == "R3" && std::string(id) == "s1";
      input.ratings.push_back({rater, id, "d", alone ? 1.0 : 0.0});
    }
  }
  for (const char* rater : {"R1", "R2"}) input.ratings.push_back({rater, "s1", "a", 3});
  const ValidityReport report = validity_report(input);
  EXPECT_EQ(value_of(line_of(report.checklist, "c"), "agreement"), 1.0);
  EXPECT_FALSE(value_of(line_of(report.checklist, "c"), "kappa"));
  // Of 4 times 3 pairs, 2 differ.
  EXPECT_NEAR(*value_of(line_of(report.checklist, "d"), "agreement"), 10.0 / 12.0, 1e-12);
  EXPECT_TRUE(value_of(line_of(report.checklist, "d"), "kappa"));
  EXPECT_EQ(notes_of(line_of(report.agreement, "a")),
            "sessions that all raters rated: 1; at least 3 are needed\n");
  for (const char* id : {"s2", "s3", "s4"}) input.ratings.push_back({"R1", id, "a", 4});
  EXPECT_EQ(notes_of(line_of(validity_report(input).agreement, "a")),
            "sessions that all raters rated: 1; at least 3 are needed; R2 rated only 1 of 4\n");
}

TEST(ValidityReport, MeansOfTheSameNumbersInAnotherOrderAreEqual) {
  ASSERT_NE(0.1 + 0.2 + 0.3, 0.3 + 0.2 + 0.1);
  std::vector<RatedSession> sessions;
  for (const double value : {0.1, 0.2, 0.3}) sessions.push_back(plain_session("", "A", "", value));
  for (const double value : {0.3, 0.2, 0.1}) sessions.push_back(plain_session("", "B", "", value));
  const auto means = person_means(sessions, [](const RatedSession& s) { return measure_in(s, "m"); });
  EXPECT_EQ(means.at("A"), means.at("B"));
  EXPECT_EQ(means.at("A"), 0.2);
  EXPECT_EQ(to_twelve_digits(-123456.7890124999), -123456.789012);
  EXPECT_EQ(to_twelve_digits(0.0), 0.0);
}

TEST(ValidityReport, TooFewPersonsAreAnsweredInWordsAndWithoutNumbers) {
  ValidityInput input;
  for (int i = 0; i < 2; ++i)
    input.sessions.push_back(plain_session("e" + std::to_string(i), "E" + std::to_string(i), "expert", i));
  for (int i = 0; i < 5; ++i)
    input.sessions.push_back(plain_session("n" + std::to_string(i), "N" + std::to_string(i), "novice", i));
  const ValidityReport report = validity_report(input);
  const ValidityLine& line = line_of(report.known_groups, "m");
  EXPECT_EQ(value_of(line, "n_experts"), 2.0);
  EXPECT_TRUE(value_of(line, "mean_novices"));
  for (const char* name : {"mean_experts", "welch_p", "auc", "hedges_g", "difference"})
    EXPECT_FALSE(value_of(line, name)) << name;
  EXPECT_NE(notes_of(line).find("2 experts with a value; at least 3 are needed"), std::string::npos)
      << notes_of(line);
  EXPECT_FALSE(value_of(line_of(report.benchmarks, "m"), "mean"));
}

TEST(ValidityReport, AnEmptyStudySaysWhyThereIsNothing) {
  const ValidityReport report = validity_report({});
  EXPECT_TRUE(report.known_groups.empty() && report.changes.empty() && report.agreement.empty());
  EXPECT_EQ(report.notes.size(), 5u);
}

TEST(ValidityReport, RatersTotalIsTheMeanOfRatersWhoRatedAll) {
  ValidityInput input;
  input.sessions = {plain_session("s", "A", "novice", 1.0)};
  // Nobody has rated the last item, so that nobody has left it out.
  input.items = {
      {"a", ItemKind::scale}, {"b", ItemKind::scale}, {"c", ItemKind::check}, {"z", ItemKind::scale}};
  input.ratings = {{"R1", "s", "a", 3}, {"R1", "s", "b", 5}, {"R1", "s", "c", 1},
                   {"R2", "s", "a", 1}, {"R2", "s", "b", 1}, {"R3", "s", "a", 5}};
  // R1 says 8, R2 says 2, R3 has left b out.
  EXPECT_EQ(measure_in(with_raters_total(input).front(), raters_total), 5.0);
  EXPECT_EQ(RatingTable::of_total(input).raters(), 3u);
  const ValidityReport report = validity_report(input);
  EXPECT_EQ(value_of(line_of(report.agreement, raters_total), "dropped"), 1.0);
}

TEST(ValidityReport, AnEffectIsFoundWhereThereIsOne) {
  const ValidityReport report = validity_report(ream::test::simulated_study({.seed = ream::test::seed(86),
                                                                             .experts = 25,
                                                                             .novices = 40,
                                                                             .expert_skill = 2.5,
                                                                             .trained_gain = 2.0}));
  const ValidityLine& time = line_of(report.known_groups, "slips");
  EXPECT_LT(*value_of(time, "welch_p_holm"), 0.05);
  EXPECT_LT(*value_of(time, "auc_high"), 0.5);  // experts slip less
  EXPECT_EQ(value_of(time, "experts_at_least"), 0.0);
  EXPECT_GT(*value_of(line_of(report.agreement, raters_total), "icc_average_low"), 0.5);
  EXPECT_LT(*value_of(line_of(report.correlations, "slips"), "pearson_high"), 0.0);
  const ValidityLine& arms = line_of(report.arm_differences, raters_total, "guided-plain:post");
  EXPECT_GT(*value_of(arms, "ancova_low"), 0.0);
  const ValidityReport untrained = validity_report(
      ream::test::simulated_study({.seed = ream::test::seed(86), .novices = 40, .trained_gain = 0.0}));
  const ValidityLine& curve = line_of(untrained.learning, "duration_s");
  ASSERT_TRUE(value_of(curve, "rate")) << notes_of(curve);
  EXPECT_NEAR(*value_of(curve, "rate"), 0.6, 0.25);
}

TEST(ValidityReport, HolmsPIsNeverBelowTheOther) {
  const ValidityReport report = validity_report(ream::test::simulated_study({.seed = ream::test::seed()}));
  size_t judged = 0;
  for (const auto& [name, lines] : parts_of(report))
    for (const ValidityLine& line : *lines)
      for (const auto& [key, value] : line.values)
        if (key.ends_with("_holm")) {
          EXPECT_GE(value, *value_of(line, key.substr(0, key.size() - 5))) << name << " " << line.measure;
          ++judged;
        }
  EXPECT_GT(judged, 20u);
}

TEST(ValidityReport, EqualInputsGiveEqualBitsAndAllNumbersAreFinite) {
  const ValidityInput input =
      ream::test::simulated_study({.seed = ream::test::seed(), .missing_ratings = 0.1});
  const nlohmann::json one = validity_json(validity_report(input));
  EXPECT_EQ(one.dump(), validity_json(validity_report(input)).dump());
  EXPECT_EQ(one.dump().find("null"), std::string::npos);
  for (const char* part : {"agreement", "checklist", "known_groups", "correlations", "changes",
                           "arm_differences", "benchmarks", "learning"})
    EXPECT_FALSE(one.at(part).empty()) << part;
}

TEST(ValidityReport, WhatCannotBeIsRefusedByName) {
  const ErrorKind kind = ErrorKind::invalid_input;
  const ValidityInput good = ream::test::simulated_study({});
  const auto refused = [&](const std::string& mentioned, const auto& spoil) {
    ValidityInput bad = good;
    spoil(bad);
    expect_error(kind, mentioned, [&] { (void)validity_report(bad); });
  };
  refused("is there twice", [](auto& bad) { bad.sessions.push_back(bad.sessions.front()); });
  refused("is there twice", [](auto& bad) { bad.ratings.push_back(bad.ratings.front()); });
  refused("item 'flow' is there twice", [](auto& bad) { bad.items.push_back(bad.items.front()); });
  refused("no such session", [](auto& bad) { bad.ratings.front().session = "gone"; });
  refused("no such item", [](auto& bad) { bad.ratings.front().item = "gone"; });
  refused("must be 1 to 5", [](auto& bad) { bad.ratings.front().value = 6.0; });
  refused("must be 1 to 5", [](auto& bad) { bad.ratings.front().value = std::nan(""); });
  refused("must be 0 or 1", [](auto& bad) { bad.ratings[3].value = 0.5; });
  refused("experience 'master'", [](auto& bad) { bad.sessions.front().experience = "master"; });
  refused("phase 'later'", [](auto& bad) { bad.sessions.front().phase = "later"; });
  refused("two experiences", [](auto& bad) { bad.sessions.front().experience = "novice"; });
  refused("two arms", [](auto& bad) { bad.sessions.front().arm = "plain"; });
  refused("has no participant", [](auto& bad) { bad.sessions.front().participant = ""; });
  refused("no measure may be called so",
          [](auto& bad) { bad.sessions.front().measures[raters_total] = 1.0; });
}

TEST(ValidityTables, AreThoseThatTheScriptReads) {
  ValidityInput input;
  input.sessions = {plain_session("s1", "A", "novice", 1.5), {"s2", "B", "", "x", "pre", {{"k", 2.0}}, 3}};
  input.items = {{"a", ItemKind::scale}, {"c", ItemKind::check}};
  input.ratings = {{"R1", "s1", "a", 3}, {"R1", "s1", "c", 1}};
  EXPECT_EQ(session::csv_of(validity_sessions_table(input)),
            "session,participant,experience,arm,phase,attempt,k,m\r\ns1,A,novice,,,0,,1.5\r\n"
            "s2,B,,x,pre,3,2.0,\r\n");
  EXPECT_EQ(session::csv_of(validity_ratings_table(input)),
            "rater,session,item,kind,value\r\nR1,s1,a,scale,3.0\r\nR1,s1,c,check,1.0\r\n");
}

}  // namespace
}  // namespace ream::study
