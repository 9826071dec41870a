#include <gtest/gtest.h>

#include <algorithm>

#include "report/report.hpp"
#include "unit/report/example_material.hpp"

namespace ream::report {
namespace {

const MetricLine& line(const Report& report, const std::string& name) {
  for (const MetricTable& table : report.tables)
    for (const MetricLine& each : table.lines)
      if (each.name == name) return each;
  throw std::logic_error("no line " + name);
}

std::string fact(const std::vector<Fact>& facts, const std::string& name) {
  const auto found = std::find_if(facts.begin(), facts.end(), [&](const Fact& f) { return f.name == name; });
  return found == facts.end() ? "" : found->value;
}

TEST(MakeReport, PutsPlanBesideWhatWasAchieved) {
  const Report report = make_report(test::full_material());
  EXPECT_EQ(line(report, "Version achieved").value, "3.2\u00b0 retroversion");
  EXPECT_EQ(line(report, "Version achieved").planned, "2.0\u00b0 retroversion");
  EXPECT_EQ(line(report, "Reaming depth").planned, "2.00\u00a0mm");
  EXPECT_EQ(line(report, "Seating").value, "85\u00a0%");
  EXPECT_EQ(line(report, "Seating").pass, "\u2265\u00a090\u00a0%");
  EXPECT_EQ(line(report, "Seating").warn, "\u2265\u00a080\u00a0%");
  EXPECT_EQ(line(report, "Seating").mark, Mark::warn);
  EXPECT_EQ(line(report, "Seating").points, "") << "it decides, and weighs nothing";
  EXPECT_EQ(line(report, "Depth error").points, "82 \u00d7 4");
  EXPECT_EQ(line(report, "Mean thrust").pass, "35 to 70\u00a0N");
  EXPECT_EQ(line(report, "Duration").mark, Mark::none);
  EXPECT_TRUE(line(report, "Vault breach").critical);
  EXPECT_EQ(report.verdict, "Passed");
  EXPECT_TRUE(report.missing.empty());
}

TEST(MakeReport, EveryMetricIsThereOnceWithItsSource) {
  const Report report = make_report(test::full_material());
  size_t lines = 0;
  for (const MetricTable& table : report.tables)
    for (const MetricLine& each : table.lines) {
      ++lines;
      ASSERT_GE(each.source, 1) << each.name;
      ASSERT_LE(static_cast<size_t>(each.source), report.sources.size()) << each.name;
    }
  EXPECT_EQ(lines, score::metric_catalogue().size() - 6)
      << "planned angles, depth, joint line, seating and plate stand beside others";
  ASSERT_EQ(report.meanings.size(), score::metric_catalogue().size());
  for (size_t i = 0; i < report.meanings.size(); ++i) {
    const score::Metric& metric = score::metric_catalogue()[i];
    const std::string& words = report.meanings[i].value;
    EXPECT_TRUE(report.meanings[i].name.starts_with(metric.name));
    EXPECT_NE(words.find(metric.definition), std::string::npos) << words;
    EXPECT_NE(words.find(metric.confidence), std::string::npos) << words;
    EXPECT_NE(words.find("Source "), std::string::npos) << words;
  }
  EXPECT_EQ(report.meanings[2].name, "Version error, \u00b0");
}

TEST(MakeReport, SaysWhoWhatAndUnderWhichConditions) {
  test::full_material();
  Material m = test::full_material();
  m.session.theatre = true;
  const Report named = make_report(m);
  EXPECT_EQ(fact(named.facts, "Trainee"), "Zo\u00eb \u00d6zt\u00fcrk");
  EXPECT_EQ(fact(named.facts, "Date"), "31 January 2026, 09:05 UTC");
  EXPECT_EQ(fact(named.facts, "Theatre mode"), "on");
  EXPECT_EQ(fact(named.facts, "Force scale"), "26 simulated N for 1 N at the hand");
  EXPECT_NE(named.judged_by.find("version 2; theatre mode on"), std::string::npos);
  EXPECT_EQ(fact(named.provenance, "Session hash"), "0123456789abcdef");
  m.session.blinded = true;
  m.session.trainee = "P-07";
  EXPECT_EQ(fact(make_report(m).facts, "Participant"), "P-07");
  EXPECT_EQ(fact(make_report(m).facts, "Trainee"), "");
}

TEST(MakeReport, ABreachDecidesAndIsMarked) {
  Material m = test::full_material();
  m.metrics["vault_breach_mm"] = 0.4;
  m.score = score::apply_rubric(m.rubric, m.metrics);
  const Report report = make_report(m);
  EXPECT_EQ(report.verdict, "Failed");
  EXPECT_EQ(line(report, "Vault breach").mark, Mark::fail);
  EXPECT_NE(report.reasons.front().find("Vault breach failed; it is a critical criterion"),
            std::string::npos);
}

TEST(MakeReport, LimitsAreThoseOfTheRubric) {
  Material m = test::full_material();
  m.rubric.criteria = {
      {"entry_error_mm", std::nullopt, score::Band{score::Better::less, 0.25, 0.5, 0.0}, 2.0, false}};
  m.score = score::apply_rubric(m.rubric, m.metrics);
  const Report report = make_report(m);
  EXPECT_EQ(line(report, "Entry error").pass, "\u2264\u00a00.25\u00a0mm");
  EXPECT_EQ(line(report, "Entry error").mark, Mark::fail);
  EXPECT_EQ(line(report, "Version error").points, "") << "not weighed by this rubric";
}

TEST(MakeReport, WhatIsNotSaidIsSaidToBe) {
  const Report report = make_report(test::empty_material());
  EXPECT_EQ(report.verdict, "Not assessed");
  EXPECT_EQ(report.points, "");
  for (const MetricTable& table : report.tables)
    for (const MetricLine& each : table.lines) {
      EXPECT_EQ(each.value, "") << each.name;
      EXPECT_EQ(each.mark, Mark::missing) << each.name;
    }
  ASSERT_EQ(report.missing.size(), 1u) << "one reason for all";
  EXPECT_EQ(report.missing[0].value, "the reamer never touched bone");
  EXPECT_TRUE(report.charts.empty());
  EXPECT_FALSE(report.why_no_charts.empty());
  EXPECT_EQ(fact(report.facts, "Trainee"), "not named");
}

TEST(MakeReport, PointsThatRestOnLittleSaySo) {
  Material m = test::full_material();
  m.metrics["version_error_deg"] = nullptr;
  m.score = score::apply_rubric(m.rubric, m.metrics);
  EXPECT_NE(make_report(m).points.find("on 86\u00a0% of the rubric"), std::string::npos)
      << make_report(m).points;
}

TEST(MakeReport, TellsTheCourseOfLearning) {
  Material m = test::full_material();
  EXPECT_EQ(make_report(m).learning_words, "");
  score::LearningPoint passed;
  passed.outcome = score::Outcome::pass;
  passed.points = 80.0;
  m.learning = score::learning_curve({}, {passed});
  EXPECT_EQ(make_report(m).learning_words, "This is the trainee's first session that counts.");
  m.learning = score::learning_curve({}, {passed, passed, passed});
  const Report report = make_report(m);
  EXPECT_NE(report.learning_words.find("After 3 sessions: going on. Passing the next 5"), std::string::npos);
  EXPECT_EQ(report.learning_charts.size(), 2u);
}

TEST(MakeReport, ComparesWithTheBenchmark) {
  Material m = test::full_material();
  m.benchmark = score::Benchmark{"ours",
                                 {},
                                 {{"duration_s", score::Better::less, 2.0, 0.0, 3, {}},
                                  {"seating_percent", score::Better::more, 95.0, 1.0, 3, {}}}};
  const Report report = make_report(m);
  EXPECT_EQ(report.benchmark_words, "Benchmark \u201cours\u201d: 1 of 2 reached.");
  EXPECT_EQ(fact(report.benchmark, "Seating"), "85\u00a0%, not reached (at least 95\u00a0%)");
}

TEST(MakeReport, AComponentUnderLoadHasAPageOfItsOwn) {
  Material material = test::full_material();
  EXPECT_EQ(html_of(make_report(material)).find("Component under load"), std::string::npos);
  LoadMaterial load;
  load.force_n = 750.0;
  load.cell_mm = 1.0;
  load.law = "morgan-2003: E = 8920 g^1.83 MPa";
  load.states = {{"Before", 42.3, 64.8, 93.4, 0.00231, 12.5}, {"As reamed", 100.0, 7.7, 3.5, {}, 0.0}};
  material.load = load;
  const Report report = make_report(material);
  ASSERT_TRUE(report.load);
  const std::vector<std::vector<std::string>> rows = {
      {"Supported by bone, without load", "42\u00a0%", "100\u00a0%"},
      {"Support that a load lifts off", "65\u00a0%", "8\u00a0%"},
      {"Micromotion index: component against bone", "93\u00a0\u00b5m", "4\u00a0\u00b5m"},
      {"Peak strain of the subchondral plate", "0.23\u00a0%", "no plate is left"},
      {"Bone within 3 mm that is strained beyond 0.7\u00a0%", "12.5\u00a0%", "0.0\u00a0%"}};
  EXPECT_EQ(report.load->rows, rows);
  EXPECT_EQ(report.load->heads, (std::vector<std::string>{"", "Before", "As reamed"}));
  EXPECT_EQ(report.load->assumptions.find("rough"), std::string::npos);
  const std::string html = html_of(report);
  for (const auto& row : rows)
    for (const std::string& cell : row) EXPECT_NE(html.find(cell), std::string::npos) << cell;
  EXPECT_FALSE(pdf_of(report).empty());
  material.load->settled = false;
  EXPECT_NE(make_report(material).load->assumptions.find("rough"), std::string::npos);
}

}  // namespace
}  // namespace ream::report
