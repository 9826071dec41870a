#include "study/study_design.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "support/expect_error.hpp"
#include "support/seed.hpp"

namespace ream::study {
namespace {

using nlohmann::json;

StudyDesign two_arms() {
  StudyDesign design;
  design.arms = {{"control", "No training", 0, false, "", ""},
                 {"trained", "Three sessions", 3, true, "", "touch"}};
  design.retention_sessions = 1;
  return design;
}

StudyDesign of_arms(size_t count) {
  StudyDesign design;
  for (size_t i = 0; i < count; ++i)
    design.arms.push_back({"a" + std::to_string(i), "Arm", 1, false, "", ""});
  return design;
}

TEST(StudyDesign, ComesBackAsItWasWritten) {
  StudyDesign design = two_arms();
  design.test_case = "hard";
  EXPECT_EQ(to_json(design_from(to_json(design))), to_json(design));
  const StudyDesign short_form =
      design_from(json::parse(R"({"arms": [{"id": "all", "name": "All", "training_sessions": 2}]})"));
  EXPECT_EQ(short_form.pre_sessions, 1);
  EXPECT_EQ(short_form.post_sessions, 1);
  EXPECT_EQ(short_form.retention_sessions, 0);
  EXPECT_FALSE(short_form.arms.at(0).theatre);
  json twice = to_json(design);
  twice["arms"][1]["id"] = "control";
  test::expect_error(ErrorKind::invalid_input, "control", [&] { design_from(twice); });
}

TEST(StudyDesign, PhasesHaveNames) {
  for (const Phase phase : {Phase::pre, Phase::training, Phase::post, Phase::retention})
    EXPECT_EQ(phase_from(to_text(phase)), phase);
  EXPECT_FALSE(phase_from(""));
  EXPECT_FALSE(phase_from("Pre"));
}

TEST(StudyDesign, ArmsAreNeverFarFromEquallyMany) {
  for (const size_t count : {1u, 2u, 3u, 5u}) {
    const StudyDesign design = of_arms(count);
    std::map<std::string, int> times;
    int even = 0;
    for (int64_t place = 0; place < 300; ++place) {
      ++times[arm_at(design, "seed", "novice", place).id];
      int least = 300, most = 0;
      for (const StudyArm& arm : design.arms) {
        least = std::min(least, times[arm.id]);
        most = std::max(most, times[arm.id]);
      }
      ASSERT_LE(most - least, 3) << count << " arms, place " << place;
      even += most == least;
    }
    EXPECT_GE(even, 300 / (3 * static_cast<int>(count))) << "after each block they are";
  }
}

TEST(StudyDesign, TheSequenceIsThatOfSeedAndStratumAndGoesEveryWay) {
  const StudyDesign design = two_arms();
  const auto sequence = [&](const std::string& seed, const std::string& stratum) {
    std::string text;
    for (int64_t place = 0; place < 40; ++place) text += arm_at(design, seed, stratum, place).id[0];
    return text;
  };
  EXPECT_EQ(sequence("k3m7pq2x", "novice"), sequence("k3m7pq2x", "novice"));
  EXPECT_NE(sequence("k3m7pq2x", "novice"), sequence("k3m7pq2x", "expert"));
  EXPECT_NE(sequence("k3m7pq2x", "novice"), sequence("k3m7pq2y", "novice"));
  // With two arms the first two places are equal in 1/3 x 0 + 1/3 x 1/3 + 1/3 x 2/5 of sequences, and the
  // arms change places without a difference: chi square with 3 degrees, 0.1 % is 16.3.
  const uint64_t seed = test::seed(1);
  std::map<std::string, double> orders;
  constexpr int draws = 6000;
  for (int i = 0; i < draws; ++i) {
    std::string order;
    for (int64_t place = 0; place < 2; ++place)
      order += arm_at(design, std::to_string(seed + static_cast<uint64_t>(i)), "novice", place).id[0];
    ++orders[order];
  }
  const double equal = draws * (1.0 / 9.0 + 2.0 / 15.0) / 2.0, different = draws / 2.0 - equal;
  double chi_square = 0.0;
  for (const auto& [order, expected] :
       {std::pair("cc", equal), {"tt", equal}, {"ct", different}, {"tc", different}})
    chi_square += (orders[order] - expected) * (orders[order] - expected) / expected;
  EXPECT_LT(chi_square, 16.3) << "seed " << seed;
}

TEST(StudyDesign, AParticipantIsTestedTrainsAndIsTestedAgain) {
  const StudyDesign design = two_arms();
  const StudyArm& trained = *find_arm(design, "trained");
  std::vector<DoneSession> done;
  std::string course;
  while (const auto next = next_session(design, trained, done)) {
    course += std::string(to_text(next->phase)) + std::to_string(next->number) + "/" +
              std::to_string(next->of) + " ";
    EXPECT_EQ(next->not_before_day, next->phase == Phase::retention ? 104 + 14 : 0);
    done.push_back({next->phase, 100 + static_cast<int64_t>(done.size())});
  }
  EXPECT_EQ(course, "pre1/1 training1/3 training2/3 training3/3 post1/1 retention1/1 ");
  EXPECT_EQ(next_session(design, *find_arm(design, "control"), {{Phase::pre, 7}})->phase, Phase::post);
  EXPECT_EQ(find_arm(design, "other"), nullptr);
}

TEST(StudyDesign, SessionsOutsideThePhasesDoNotCount) {
  const StudyDesign design = two_arms();
  const auto next = next_session(design, design.arms[1], {{std::nullopt, 3}, {std::nullopt, 4}});
  ASSERT_TRUE(next);
  EXPECT_EQ(next->phase, Phase::pre);
}

}  // namespace
}  // namespace ream::study
