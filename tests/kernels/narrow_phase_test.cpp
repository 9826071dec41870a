#include "collide/narrow_phase_cl.hpp"
#include "every_device.hpp"
#include "reaming_scene.hpp"

namespace ream::collide {
namespace {

/// One lane as on CPUs, and groups of lanes as on GPUs, also where one group gets many blocks or none.
constexpr LaunchShape shapes[] = {{16, 1}, {1, 1}, {3, 8}, {2, 64}};
constexpr int pose_count = 1000;

TEST(NarrowPhaseCl, SumsEqualTheCppTwinAtAThousandRandomPoses) {
  test::ReamingScene scene(31);
  std::cout << "seed 31, " << scene.contact.size() << " points in " << scene.contact.blocks.size()
            << " blocks\n";
  const auto cpu = make_narrow_phase_cpu(scene.contact_input());
  std::mt19937 random(31);
  std::vector<QuantisedPose> poses;
  std::vector<ContactSums> expected(pose_count);
  int64_t engaged = 0, guided = 0;
  for (auto& sums : expected) {
    poses.push_back(scene.random_pose(random));
    ASSERT_TRUE(cpu->contact(poses.back(), scene.voi(poses.back()), sums));
    engaged += sums.engaged();
    guided += sums.guiding.points;
  }
  EXPECT_GT(engaged, 250000);
  EXPECT_GT(guided, 2500);
  test::on_every_device([&](const gpu::Device& device) {
    const auto buffers = std::make_shared<BoneBuffers>(device, scene.bone);
    for (const LaunchShape shape : shapes) {
      const auto cl = make_narrow_phase_cl(scene.contact_input(), buffers, shape);
      for (size_t i = 0; i < poses.size(); ++i) {
        ContactSums sums;
        ASSERT_TRUE(cl->contact(poses[i], scene.voi(poses[i]), sums));
        ASSERT_EQ(sums, expected[i]) << "pose " << i << ", lanes " << shape.lanes;
      }
    }
  });
}

TEST(NarrowPhaseCl, NothingIsEngagedAwayFromTheBone) {
  test::ReamingScene scene(32);
  const auto buffers = std::make_shared<BoneBuffers>(gpu::choose_device("auto", gpu::Use::tick), scene.bone);
  const auto cl = make_narrow_phase_cl(scene.contact_input(), buffers, {16, 1});
  for (const double depth : {-500.0, -30.0, -4.0}) {
    const QuantisedPose pose = scene.pose(depth, Vec3::Zero(), Vec3::Zero());
    Voi everything;
    everything.touching = true;
    everything.box_tool_mm = scene.contact.bounds_mm;
    ContactSums sums;
    sums.cutting.points = 77;
    ASSERT_TRUE(cl->contact(pose, everything, sums));
    EXPECT_EQ(sums, ContactSums{});
  }
}

}  // namespace
}  // namespace ream::collide
