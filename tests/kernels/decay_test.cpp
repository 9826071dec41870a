#include "collide/decay_cl.hpp"

#include "every_device.hpp"
#include "reaming_scene.hpp"

namespace ream::collide {
namespace {

constexpr LaunchShape shapes[] = {{1, 1}, {16, 1}, {3, 8}, {2, 64}};
constexpr int pose_count = 1000;

struct Answer {
  RemovalSums sums;
  std::vector<uint32_t> changed;
  bool operator==(const Answer&) const = default;
};

Answer apply(Decay& decay, const QuantisedPose& pose) {
  Answer answer;
  EXPECT_TRUE(decay.apply(pose, answer.sums));
  EXPECT_TRUE(decay.publish());
  answer.changed.assign(decay.changed_bricks().begin(), decay.changed_bricks().end());
  return answer;
}

TEST(DecayCl, TakesWhatTheCppTwinTakesAtAThousandRandomPoses) {
  constexpr unsigned seed = 51;
  std::cout << "seed " << seed << '\n';
  test::ReamingScene cpu_scene(seed);
  const DecayShell shell = make_decay_shell(shell::make_point_shell(cpu_scene.tool, 0.25));
  std::mt19937 random(seed);
  std::vector<QuantisedPose> poses;
  for (int i = 0; i < pose_count; ++i) poses.push_back(cpu_scene.random_pose(random));
  const auto cpu = make_decay_cpu({shell, cpu_scene.bone});
  std::vector<Answer> expected;
  size_t changed = 0;
  for (const auto& pose : poses) {
    expected.push_back(apply(*cpu, pose));
    changed += !expected.back().changed.empty();
  }
  EXPECT_GT(changed, pose_count * 3 / 4);
  test::on_every_device([&](const gpu::Device& device) {
    for (const LaunchShape shape : shapes) {
      SCOPED_TRACE(std::to_string(shape.groups) + " groups of " + std::to_string(shape.lanes));
      test::ReamingScene scene(seed);
      const auto buffers = std::make_shared<BoneBuffers>(device, scene.bone);
      const auto cl = make_decay_cl({shell, scene.bone}, buffers, shape);
      for (size_t i = 0; i < poses.size(); ++i) ASSERT_EQ(apply(*cl, poses[i]), expected[i]) << "pose " << i;
      ASSERT_EQ(scene.bone.coverage, cpu_scene.bone.coverage);
    }
  });
}

}  // namespace
}  // namespace ream::collide
