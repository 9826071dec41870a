#include "openigtlink/messages.hpp"

#include <Eigen/LU>

#include <gtest/gtest.h>

#include "ct/phantom/phantom_case.hpp"
#include "openigtlink/telemetry_messages.hpp"
#include "support/igtl_by_the_book.hpp"
#include "support/random_pose.hpp"
#include "support/seed.hpp"

namespace ream::openigtlink {
namespace {

TEST(Ras, LeftBecomesRightAndBackBecomesFront) {
  EXPECT_EQ(ras_from_world().point(Vec3(10.0, 20.0, 30.0)), Vec3(-10.0, -20.0, 30.0));
  EXPECT_EQ(ras_from_world().direction(Vec3::UnitX()), -Vec3::UnitX()) << "left";
  EXPECT_EQ(ras_from_world().direction(Vec3::UnitY()), -Vec3::UnitY()) << "posterior";
  EXPECT_EQ(ras_from_world().direction(Vec3::UnitZ()), Vec3::UnitZ()) << "superior";
}

TEST(Ras, RotationsStayRotations) {
  std::mt19937 random(test::seed(11));
  for (int i = 0; i < 100; ++i) {
    const Pose world_from_tool = test::random_pose(random);
    const Pose ras_from_tool = ras_from(world_from_tool);
    EXPECT_NEAR(ras_from_tool.rotation.determinant(), 1.0, 1e-12);
    EXPECT_TRUE((ras_from_tool.rotation.transpose() * ras_from_tool.rotation).isIdentity(1e-12));
    const Vec3 of_tool(3.0, -4.0, 5.0);
    EXPECT_TRUE(
        ras_from_tool.point(of_tool).isApprox(ras_from_world().point(world_from_tool.point(of_tool))));
    const Pose moved = moved_in_ras(world_from_tool);
    EXPECT_NEAR(moved.rotation.determinant(), 1.0, 1e-12);
    EXPECT_TRUE(moved.point(ras_from_world().point(of_tool))
                    .isApprox(ras_from_world().point(world_from_tool.point(of_tool))));
  }
}

/// "ReamerToRas" of a tool that stands on a shoulder's planned axis.
std::array<float, 12> sent_on_axis(const case_::Case& shoulder) {
  stream::TelemetrySample tick;
  tick.world_from_tool = {rotation_with_z_along(shoulder.plan->axis_direction), shoulder.plan->entry_mm};
  MessageCache cache;
  LastSent sent;
  put_tick(tick, 0, sent, cache);
  return test::IgtlByTheBook::read(*cache.message(static_cast<size_t>(Topic::reamer_pose)).message).transform;
}

/// What an anatomist knows: the reamer goes from lateral to medial, that is towards the left in a right
/// shoulder and towards the right in a left one; and the glenoid looks forward, so it goes backward.
TEST(Ras, TheReamerGoesMedialAndBackwardInEitherShoulder) {
  for (const case_::Side side : {case_::Side::right, case_::Side::left}) {
    ct::PhantomParams params = ct::phantom_preset("demo").params;
    params.side = side;
    params.spacing_mm = Vec3::Constant(1.5);
    const case_::Case shoulder = ct::make_phantom_case("shoulder", params, 1);
    const std::array<float, 12> sent = sent_on_axis(shoulder);
    const float towards_right = sent[6], towards_front = sent[7];
    EXPECT_EQ(towards_right < 0.0f, side == case_::Side::right) << case_::to_text(side);
    EXPECT_GT(std::abs(towards_right), 0.5f);
    EXPECT_LT(towards_front, 0.0f);
    EXPECT_FLOAT_EQ(sent[9], -static_cast<float>(shoulder.plan->entry_mm.x()));
    EXPECT_FLOAT_EQ(sent[10], -static_cast<float>(shoulder.plan->entry_mm.y()));
    EXPECT_FLOAT_EQ(sent[11], static_cast<float>(shoulder.plan->entry_mm.z()));
  }
}

}  // namespace
}  // namespace ream::openigtlink
