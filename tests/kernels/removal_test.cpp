#include "collide/removal/removal_cl.hpp"

#include <algorithm>

#include "collide/contact/narrow_phase_cl.hpp"
#include "fresh_bones.hpp"
#include "support/cut_bricks.hpp"
#include "support/seed.hpp"

namespace ream::collide {
namespace {

/// Poses that go deeper and deeper, so that each of them finds something to cut, with the bricks around them.
struct Visit {
  QuantisedPose pose;
  std::vector<uint32_t> bricks;
};

std::vector<Visit> random_visits(const test::ReamingScene& scene, unsigned seed, int pose_count) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<Visit> visits;
  for (int i = 0; i < pose_count; ++i) {
    const double depth_mm = -1.0 + 9.0 * i / pose_count + unit(random);
    const Vec3 tilt(0.6 * unit(random), 0.6 * unit(random), unit(random));
    Visit visit;
    visit.pose = scene.pose(depth_mm, tilt, Vec3(9.0 * unit(random), 8.0 * unit(random), 0.0));
    const Vec3 apex = dequantised(visit.pose).translation_mm;
    for (uint32_t b = 0; b < scene.bone.grid.brick_count(); ++b) {
      const Vec3i middle = scene.bone.grid.brick_coordinates(b) * voxel::brick_edge + Vec3i::Constant(4);
      if ((scene.bone.grid.centre_mm(middle) - apex).norm() < 7.0) visit.bricks.push_back(b);
    }
    std::shuffle(visit.bricks.begin(), visit.bricks.end(), random);
    if (visit.bricks.size() > 96) visit.bricks.resize(96);
    visits.push_back(std::move(visit));
  }
  return visits;
}

/// What the C++ twin cuts at each visit, and the bone it leaves.
struct Expected {
  Expected(unsigned seed, const Vec3i& dims, int pose_count) : scene(seed, dims) {
    visits = random_visits(scene, seed, pose_count);
    const auto cpu = make_removal_cpu({scene.profile, scene.bone});
    for (const Visit& visit : visits) {
      answers.push_back(test::cut_bricks(*cpu, visit.pose, visit.bricks));
      changed += answers.back().sums.changed_bricks != 0;
    }
  }

  test::ReamingScene scene;
  std::vector<Visit> visits;
  std::vector<test::CutAnswer> answers;
  int changed = 0;
};

void expect_the_same(const Expected& expected, unsigned seed, const gpu::Device& device,
                     std::optional<size_t> max_buffer_bytes = {}, int parts = 1) {
  const auto check = [&](test::ReamingScene& scene, const std::shared_ptr<BoneBuffers>& buffers,
                         LaunchShape shape) {
    const auto cl = make_removal_cl({scene.profile, scene.bone}, buffers, shape);
    for (size_t i = 0; i < expected.visits.size(); ++i) {
      const auto& [pose, bricks] = expected.visits[i];
      const test::CutAnswer answer = test::cut_bricks(*cl, pose, bricks);
      ASSERT_EQ(answer.sums, expected.answers[i].sums) << "pose " << i;
      ASSERT_EQ(answer.outcomes, expected.answers[i].outcomes) << "pose " << i;
    }
    ASSERT_EQ(scene.bone.coverage, expected.scene.bone.coverage);
  };
  test::with_every_shape(seed, expected.scene.bone.grid.dims, device, max_buffer_bytes, parts, check);
}

TEST(RemovalCl, CutsWhatTheCppTwinCutsAtRandomPoses) {
  const uint32_t seed = test::seed(41);
  std::cout << "seed " << seed << '\n';
  const Expected expected(seed, {96, 88, 72}, test::tried_of(1000, 300));
  EXPECT_GT(expected.changed, test::tried_of(500, 150));
  test::on_every_device([&](const gpu::Device& device) { expect_the_same(expected, seed, device); });
}

TEST(RemovalCl, CutsTheSameWhereTheBoneIsInParts) {
  test::in_small_parts<Expected>(42, [](const auto&... arguments) { expect_the_same(arguments...); });
}

}  // namespace
}  // namespace ream::collide
