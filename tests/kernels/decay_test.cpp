#include "collide/removal/removal_cl.hpp"

#include "fresh_bones.hpp"
#include "support/seed.hpp"

namespace ream::collide {
namespace {

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

/// Random poses, what the C++ twin takes at each, and the bone it leaves.
struct Expected {
  Expected(unsigned seed, const Vec3i& dims, int pose_count)
      : scene(seed, dims), shell(make_decay_shell(shell::make_point_shell(scene.tool, 0.25))) {
    std::mt19937 random(seed);
    const auto cpu = make_decay_cpu({shell, scene.bone});
    for (int i = 0; i < pose_count; ++i) {
      poses.push_back(scene.random_pose(random));
      answers.push_back(apply(*cpu, poses.back()));
      changed += !answers.back().changed.empty();
    }
  }

  test::ReamingScene scene;
  DecayShell shell;
  std::vector<QuantisedPose> poses;
  std::vector<Answer> answers;
  int changed = 0;
};

void expect_the_same(const Expected& expected, unsigned seed, const gpu::Device& device,
                     std::optional<size_t> max_buffer_bytes = {}, int parts = 1) {
  const auto check = [&](test::ReamingScene& scene, const std::shared_ptr<BoneBuffers>& buffers,
                         LaunchShape shape) {
    const auto cl = make_decay_cl({expected.shell, scene.bone}, buffers, shape);
    for (size_t i = 0; i < expected.poses.size(); ++i)
      ASSERT_EQ(apply(*cl, expected.poses[i]), expected.answers[i]) << "pose " << i;
    ASSERT_EQ(scene.bone.coverage, expected.scene.bone.coverage);
  };
  test::with_every_shape(seed, expected.scene.bone.grid.dims, device, max_buffer_bytes, parts, check);
}

TEST(DecayCl, TakesWhatTheCppTwinTakesAtRandomPoses) {
  const uint32_t seed = test::seed(51);
  std::cout << "seed " << seed << '\n';
  const Expected expected(seed, {96, 88, 72}, test::tried_of(1000, 300));
  EXPECT_GT(expected.changed, test::tried_of(750, 225));
  test::on_every_device([&](const gpu::Device& device) { expect_the_same(expected, seed, device); });
}

TEST(DecayCl, TakesTheSameWhereTheBoneIsInParts) {
  test::in_small_parts<Expected>(52, [](const auto&... arguments) { expect_the_same(arguments...); });
}

}  // namespace
}  // namespace ream::collide
