#include "collide/narrow_phase_cl.hpp"
#include "every_device.hpp"
#include "reaming_scene.hpp"

namespace ream::collide {
namespace {

/// One lane as on CPUs, and groups of lanes as on GPUs, also where one group gets many blocks or none.
constexpr LaunchShape shapes[] = {{16, 1}, {1, 1}, {7, 32}};

TEST(NarrowPhaseCl, SumsEqualTheCppTwinAtRandomPoses) {
  test::ReamingScene scene(31);
  std::cout << "seed 31, " << scene.contact.size() << " points in " << scene.contact.blocks.size()
            << " blocks\n";
  const auto cpu = make_narrow_phase_cpu(scene.contact_input());
  test::on_every_device([&](const gpu::Device& device) {
    const auto buffers = std::make_shared<BoneBuffers>(device, scene.bone);
    for (const LaunchShape shape : shapes) {
      const auto cl = make_narrow_phase_cl(scene.contact_input(), buffers, shape);
      std::mt19937 random(31);
      int64_t engaged = 0, guided = 0;
      for (int i = 0; i < 40; ++i) {
        const QuantisedPose pose = scene.random_pose(random);
        const Voi voi = scene.voi(pose);
        ContactSums expected, sums;
        ASSERT_TRUE(cpu->contact(pose, voi, expected));
        ASSERT_TRUE(cl->contact(pose, voi, sums));
        ASSERT_EQ(sums, expected) << "pose " << i << ", lanes " << shape.lanes;
        engaged += expected.engaged();
        guided += expected.guiding.points;
      }
      EXPECT_GT(engaged, 10000);
      EXPECT_GT(guided, 100);
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
