#include "force/feed_model.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/file.hpp"
#include "support/expect_error.hpp"
#include "support/places.hpp"
#include "unit/force/thesis_lip.hpp"

namespace ream::force {
namespace {

std::unique_ptr<FeedModel> model_of(const FeedSettings& settings) {
  return make_feed_model(settings, test::thesis_lip(200));
}

EngagedBone bone_of(int bone_class, double density_g_cc) {
  EngagedBone bone;
  bone.share[static_cast<size_t>(bone_class)] = 1.0;
  bone.density_g_cc[static_cast<size_t>(bone_class)] = density_g_cc;
  return bone;
}

/// What the models owe that do not know how much of the reamer touches.
class EveryFeedModel : public testing::TestWithParam<FeedKind> {
 protected:
  static FeedSettings settings() {
    FeedSettings s;
    s.kind = GetParam();
    return s;
  }
};

TEST_P(EveryFeedModel, TakesTheReferenceThrustAtTheLawsFeed) {
  for (const double factor : {1.0, 0.712}) {
    FeedSettings s = settings();
    s.specimen_factor = factor;
    const auto model = model_of(s);
    for (int bone_class = 0; bone_class < 3; ++bone_class)
      for (int code = 0; code <= 250; ++code) {
        const CuttingLoad load = model->load(bone_of(bone_class, 0.01 * code), 52.0);
        const double feed_mm_s = empirical_feed_mm_s(bone_class, 0.01 * code, factor);
        EXPECT_NEAR(load.resistance_n_s_mm * feed_mm_s, 52.0, 1e-9) << bone_class << ", code " << code;
        EXPECT_GT(load.torque_arm_mm, 0.0);
      }
  }
}

TEST_P(EveryFeedModel, FollowsTheLawAtOtherThrusts) {
  const auto model = model_of(settings());
  for (const double thrust_n : {20.0, 35.0, 52.0, 78.0})
    for (const auto& bone : {bone_of(1, 1.5), bone_of(0, 0.55)}) {
      const double law = lawful_resistance_n_s_mm(bone, {});
      EXPECT_NEAR(model->load(bone, thrust_n).resistance_n_s_mm, law, 0.015 * law) << thrust_n << " N";
    }
}

TEST_P(EveryFeedModel, KeepsTheFeedOfARevolutionAtAnySpindleSpeed) {
  const auto at_reference = model_of(settings());
  for (const double times : {0.25, 0.5, 2.0, 4.0}) {
    FeedSettings s = settings();
    s.spindle_rad_s = times * reference_spindle_rad_s;
    const auto model = model_of(s);
    for (const double thrust_n : {10.0, 52.0}) {
      const CuttingLoad a = at_reference->load(bone_of(0, 0.6), thrust_n),
                        b = model->load(bone_of(0, 0.6), thrust_n);
      EXPECT_NEAR(a.resistance_n_s_mm / b.resistance_n_s_mm, times, 1e-9);
      EXPECT_NEAR(a.torque_arm_mm, b.torque_arm_mm, 1e-9);
    }
  }
}

TEST_P(EveryFeedModel, ClassesActSideBySide) {
  const auto model = model_of(settings());
  EngagedBone mixed = bone_of(0, 0.5);
  mixed.share = {0.25, 0.75, 0.0};
  mixed.density_g_cc = {0.5, 1.4, 0.0};
  const double expected = 0.25 * 52.0 / 0.25 + 0.75 * 52.0 / 0.04;
  EXPECT_NEAR(model->load(mixed, 52.0).resistance_n_s_mm, expected, 0.015 * expected);
}

TEST_P(EveryFeedModel, SaysTheSameBitsTwice) {
  const auto a = model_of(settings()), b = model_of(settings());
  EXPECT_EQ(a->table_hash(), b->table_hash());
  for (double thrust_n = 0.0; thrust_n < 120.0; thrust_n += 0.37) {
    const EngagedBone bone = bone_of(1, 1.1 + 0.004 * thrust_n);
    EXPECT_EQ(a->load(bone, thrust_n).resistance_n_s_mm, b->load(bone, thrust_n).resistance_n_s_mm);
    EXPECT_EQ(a->load(bone, thrust_n).torque_arm_mm, b->load(bone, thrust_n).torque_arm_mm);
  }
}

INSTANTIATE_TEST_SUITE_P(Models, EveryFeedModel, testing::Values(FeedKind::empirical, FeedKind::oblique),
                         [](const auto& kind) { return std::string(to_text(kind.param)); });

TEST(FeedKind, HasANameEach) {
  for (const FeedKind kind : {FeedKind::edge, FeedKind::empirical, FeedKind::oblique})
    EXPECT_EQ(feed_kind_from_text(to_text(kind)), kind);
  EXPECT_EQ(feed_models().size(), 3u);
  EXPECT_EQ(feed_model_names(), "edge, thesis or oblique");
  EXPECT_EQ(find_feed_kind("empirical"), FeedKind::empirical) << "as recordings called it";
  test::expect_error(ErrorKind::usage, "rubbing", [] { feed_kind_from_text("rubbing"); });
}

// Whoever adds a model adds its name to the schema of scripts.
TEST(FeedKind, NamesAreThoseOfTheScriptsSchema) {
  const auto schema = read_json_file(test::source_folder() + "/proto/script.schema.json");
  const auto& names = schema.at("properties").at("feed_model").at("enum");
  ASSERT_EQ(names.size(), feed_models().size() + 1) << "and the earlier name of thesis";
  for (size_t i = 0; i + 1 < names.size(); ++i) EXPECT_EQ(names[i], feed_models()[i].name);
  EXPECT_EQ(schema.at("properties").at("feed_model").at("default"), feed_models()[0].name);
}

}  // namespace
}  // namespace ream::force
