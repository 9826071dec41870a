#include "collide/contact/narrow_phase_cl.hpp"
#include "every_device.hpp"
#include "reaming_scene.hpp"
#include "support/full_tests.hpp"

namespace ream::collide {
namespace {

/// One lane as on CPUs, and groups of lanes as on GPUs, also where one group gets many blocks or none.
constexpr LaunchShape shapes[] = {{16, 1}, {1, 1}, {3, 8}, {2, 64}};

/// Random poses and what the C++ twin says of them.
struct Expected {
  Expected(const test::ReamingScene& scene, unsigned seed, size_t pose_count) : sums(pose_count) {
    const auto cpu = make_narrow_phase_cpu(scene.contact_input());
    std::mt19937 random(seed);
    for (auto& answer : sums) {
      poses.push_back(scene.random_pose(random));
      EXPECT_TRUE(cpu->contact(poses.back(), scene.voi(poses.back()), answer));
      engaged += answer.engaged();
      guided += answer.guiding.points;
    }
  }

  std::vector<QuantisedPose> poses;
  std::vector<ContactSums> sums;
  int64_t engaged = 0, guided = 0;
};

void expect_the_same(const test::ReamingScene& scene, const Expected& expected,
                     const std::shared_ptr<BoneBuffers>& buffers) {
  for (const LaunchShape shape : shapes) {
    const auto cl = make_narrow_phase_cl(scene.contact_input(), buffers, shape);
    for (size_t i = 0; i < expected.poses.size(); ++i) {
      ContactSums sums;
      ASSERT_TRUE(cl->contact(expected.poses[i], scene.voi(expected.poses[i]), sums));
      ASSERT_EQ(sums, expected.sums[i]) << "pose " << i << ", lanes " << shape.lanes;
    }
  }
}

TEST(NarrowPhaseCl, SumsEqualTheCppTwinAtRandomPoses) {
  test::ReamingScene scene(31);
  std::cout << "seed 31, " << scene.contact.size() << " points in " << scene.contact.blocks.size()
            << " blocks\n";
  const int poses = test::tried_of(1000, 300);
  const Expected expected(scene, 31, poses);
  EXPECT_GT(expected.engaged, 250 * poses);
  EXPECT_GT(expected.guided, 2.5 * poses);
  test::on_every_device([&](const gpu::Device& device) {
    expect_the_same(scene, expected, std::make_shared<BoneBuffers>(device, scene.bone));
  });
}

TEST(NarrowPhaseCl, SumsAreTheSameWhereTheBoneIsInParts) {
  std::cout << "seed 33\n";
  for (const auto& [dims, max_buffer_bytes, parts] : test::small_parts) {
    SCOPED_TRACE(std::to_string(parts) + " parts");
    test::ReamingScene scene(33, dims);
    const int poses = test::tried_of(200, 50);
    const Expected expected(scene, 33, poses);
    EXPECT_GT(expected.engaged, 250 * poses);
    test::on_every_device([&, limit = max_buffer_bytes, count = parts](const gpu::Device& device) {
      const auto buffers = std::make_shared<BoneBuffers>(device, scene.bone, limit);
      ASSERT_EQ(buffers->parts.count, count);
      expect_the_same(scene, expected, buffers);
    });
  }
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
