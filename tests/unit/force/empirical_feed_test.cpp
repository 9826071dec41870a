#include "force/feed_model.hpp"

#include <gtest/gtest.h>

#include "unit/force/thesis_lip.hpp"

namespace ream::force {
namespace {

std::unique_ptr<FeedModel> make_empirical(FeedSettings settings, const Lip& lip) {
  settings.kind = FeedKind::empirical;
  return make_feed_model(settings, lip);
}

EngagedBone cortical_of_density(double density_g_cc) {
  EngagedBone bone;
  bone.share = {0, 1, 0};
  bone.density_g_cc = {0, density_g_cc, 0};
  return bone;
}

TEST(EmpiricalFeed, IsLinearInThrustToTheBit) {
  const auto model = make_empirical({}, test::thesis_lip(100));
  for (const double thrust_n : {0.0, 1.0, 52.0, 300.0})
    EXPECT_EQ(model->load(cortical_of_density(1.5), thrust_n).resistance_n_s_mm,
              lawful_resistance_n_s_mm(cortical_of_density(1.5), {}));
}

TEST(EmpiricalFeed, TakesItsTorqueFromTheLipsAtTheReferenceFeed) {
  const Lip lip = test::thesis_lip(200);
  const auto model = make_empirical({}, lip);
  for (const double density_g_cc : {1.2, 1.5, 1.9}) {
    const double feed_mm = (0.11 - 0.05 * density_g_cc) / 2.6;
    const LipLoad load = whole_load(lip_loads(lip, {}, {feed_mm}));
    EXPECT_NEAR(model->load(cortical_of_density(density_g_cc), 20.0).torque_arm_mm,
                load.torque_n_mm / load.thrust_n, 1e-4 * load.torque_n_mm / load.thrust_n);
  }
}

}  // namespace
}  // namespace ream::force
