#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <numbers>
#include <set>

#include "core/file.hpp"
#include "statistics/distributions.hpp"
#include "study/validity_tables.hpp"
#include "support/places.hpp"
#include "support/seed.hpp"
#include "support/simulated_study.hpp"
#include "support/temporary_folder.hpp"

namespace ream::study {
namespace {

#define REAM_SKIP_WITHOUT_R()                                                                        \
  if (std::system("command -v Rscript >/dev/null 2>&1") != 0)                                        \
  GTEST_SKIP()                                                                                       \
      << "Rscript is not installed (package r-base-core), so that no number of the validity report " \
         "is compared with R"

using Numbers = std::map<std::string, double>;

/// Rows of a table of numbers by "result / measure / statistic". Names may hold commas in quotes.
Numbers numbers_in(const std::string& csv) {
  Numbers numbers;
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::vector<std::string> cells(1);
    bool quoted = false;
    for (const char c : line) {
      if (c == '"') quoted = !quoted;
      if (c == ',' && !quoted) cells.emplace_back();
      if (c != '"' && c != '\r' && (c != ',' || quoted)) cells.back() += c;
    }
    if (cells.size() != 4) throw std::runtime_error("not four cells: " + line);
    if (!numbers.emplace(cells[0] + " / " + cells[1] + " / " + cells[2], std::stod(cells[3])).second)
      throw std::runtime_error("twice: " + line);
  }
  return numbers;
}

Numbers numbers_by_r(const ValidityInput& input) {
  const ream::test::TemporaryFolder folder;
  folder.write("sessions.csv", session::csv_of(validity_sessions_table(input)));
  folder.write("ratings.csv", session::csv_of(validity_ratings_table(input)));
  const std::string at = folder.path().string();
  const std::string command = "Rscript --vanilla '" + ream::test::source_folder() +
                              "/proto/analysis/validity.R' '" + at + "' '" + at + "/numbers.csv' >'" + at +
                              "/log' 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0) << read_text_file(folder.path() / "log");
  return numbers_in(read_text_file(folder.path() / "numbers.csv"));
}

bool is_bootstrap(const std::string& name) { return name.find("auc_bootstrap") != std::string::npos; }

/// How far two bootstraps of a percentile may be apart. The error of a share q of B draws is
/// sqrt(q (1 - q) / B) / density, with the normal density of the bootstrap's own deviation; four such errors
/// of both, and a step of the area, which is not smooth.
double bootstrap_tolerance(double deviation, size_t ours, double pairs) {
  const double z = statistics::normal_quantile(0.975);
  const double density = std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi) / deviation;
  const double each = std::sqrt(0.025 * 0.975) / density;
  constexpr double samples_of_r = 10000.0;
  return 4.0 * each * std::sqrt(1.0 / static_cast<double>(ours) + 1.0 / samples_of_r) + 1.0 / pairs;
}

void expect_same(const ValidityInput& input) {
  const Numbers ours = numbers_in(session::csv_of(validity_numbers_table(validity_report(input))));
  const Numbers theirs = numbers_by_r(input);
  size_t compared = 0;
  double worst = 0.0, worst_bootstrap = 0.0;
  for (const auto& [name, value] : ours) {
    const auto found = theirs.find(name);
    ASSERT_NE(found, theirs.end()) << name << " is not in R's numbers";
    double tolerance = 1e-3;
    if (is_bootstrap(name)) {
      const std::string line = name.substr(0, name.rfind(" / ") + 3);
      tolerance = bootstrap_tolerance(theirs.at(line + "auc_bootstrap_sd"), input.bootstrap_samples,
                                      ours.at(line + "n_experts") * ours.at(line + "n_novices"));
      worst_bootstrap = std::max(worst_bootstrap, std::abs(value - found->second) / tolerance);
    } else {
      worst = std::max(worst, std::abs(value - found->second));
    }
    EXPECT_NEAR(value, found->second, tolerance) << name;
    ++compared;
  }
  for (const auto& [name, value] : theirs)
    EXPECT_TRUE(ours.contains(name) || name.ends_with("auc_bootstrap_sd"))
        << name << " is R's alone: " << value;
  std::cout << compared << " numbers compared; but for the bootstrap's they are " << worst
            << " apart at most; the bootstrap's " << worst_bootstrap << " of what chance allows\n";
}

TEST(ValidityInR, TenExpertsAndTenNovicesWithTwoRaters) {
  REAM_SKIP_WITHOUT_R();
  expect_same(ream::test::simulated_study({.seed = ream::test::seed(81), .trial = false}));
}

TEST(ValidityInR, ATrialOfTwoArmsWithThreeRatersAndMissingRatings) {
  REAM_SKIP_WITHOUT_R();
  expect_same(ream::test::simulated_study(
      {.seed = ream::test::seed(82), .experts = 8, .novices = 24, .raters = 3, .missing_ratings = 0.05}));
}

TEST(ValidityInR, WithoutAnEffectAndWithoutRaters) {
  REAM_SKIP_WITHOUT_R();
  expect_same(ream::test::simulated_study({.seed = ream::test::seed(83),
                                           .experts = 55,
                                           .novices = 60,
                                           .raters = 0,
                                           .expert_skill = 0.0,
                                           .trained_gain = 0.0}));
}

TEST(ValidityInR, GroupsThatAreTooSmallHaveNoNumbersInEither) {
  REAM_SKIP_WITHOUT_R();
  expect_same(ream::test::simulated_study(
      {.seed = ream::test::seed(84), .experts = 2, .novices = 4, .raters = 1, .missing_ratings = 0.3}));
  expect_same(
      ream::test::simulated_study({.seed = ream::test::seed(85), .experts = 3, .novices = 3, .raters = 2}));
}

TEST(ValidityInR, PhasesWithoutATestBeforeTakeTheFirstSessions) {
  REAM_SKIP_WITHOUT_R();
  ValidityInput input =
      ream::test::simulated_study({.seed = ream::test::seed(87), .experts = 7, .novices = 12});
  for (RatedSession& session : input.sessions)
    if (session.phase == "pre") session.phase = "training";
  std::reverse(input.sessions.begin(), input.sessions.end());
  expect_same(input);
}

TEST(ValidityInR, WhatHasNoNumberHasNoneInEither) {
  REAM_SKIP_WITHOUT_R();
  ValidityInput input;
  input.items = {{"low", ItemKind::scale},     {"same", ItemKind::scale}, {"crossed", ItemKind::scale},
                 {"unrated", ItemKind::scale}, {"done", ItemKind::check}, {"often", ItemKind::check}};
  const double low[3][2] = {{2, 3}, {3, 2}, {3, 4}}, crossed[3][2] = {{1, 3}, {3, 1}, {2, 2}};
  for (size_t i = 0; i < 3; ++i) {
    const std::string code = "s" + std::to_string(i);
    input.sessions.push_back({code, "P" + code, "novice", "", "", {{"m", 1.87}}, 1});
    for (size_t j = 0; j < 2; ++j) {
      const std::string rater = "R" + std::to_string(j);
      input.ratings.push_back({rater, code, "low", low[i][j]});
      input.ratings.push_back({rater, code, "same", 3.0});
      input.ratings.push_back({rater, code, "crossed", crossed[i][j]});
      input.ratings.push_back({rater, code, "done", 1.0});
      input.ratings.push_back({rater, code, "often", i > j ? 1.0 : 0.0});
    }
  }
  expect_same(input);
}

TEST(ValidityInR, ManySeeds) {
  REAM_SKIP_WITHOUT_R();
  for (uint32_t i = 0; i < 6; ++i)
    expect_same(ream::test::simulated_study({.seed = ream::test::seed(90) + i,
                                             .experts = static_cast<int>(4 + 3 * i),
                                             .novices = static_cast<int>(6 + 5 * i),
                                             .raters = static_cast<int>(2 + i % 3),
                                             .trial = i % 2 == 0,
                                             .missing_ratings = 0.02}));
}

}  // namespace
}  // namespace ream::study
