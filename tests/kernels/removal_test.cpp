#include "collide/removal_cl.hpp"

#include <algorithm>

#include "collide/narrow_phase_cl.hpp"
#include "every_device.hpp"
#include "reaming_scene.hpp"
#include "support/cut_bricks.hpp"

namespace ream::collide {
namespace {

constexpr LaunchShape shapes[] = {{1, 1}, {16, 1}, {3, 8}, {2, 64}};

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

/// Cuts a bone of its own for every launch shape.
void expect_the_same(const Expected& expected, unsigned seed, const gpu::Device& device,
                     std::optional<size_t> largest_buffer_bytes = {}, int parts = 1) {
  for (const LaunchShape shape : shapes) {
    SCOPED_TRACE(std::to_string(shape.groups) + " groups of " + std::to_string(shape.lanes));
    test::ReamingScene scene(seed, expected.scene.bone.grid.dims);
    const auto buffers = std::make_shared<BoneBuffers>(device, scene.bone, largest_buffer_bytes);
    ASSERT_EQ(buffers->parts.count, parts);
    const auto cl = make_removal_cl({scene.profile, scene.bone}, buffers, shape);
    for (size_t i = 0; i < expected.visits.size(); ++i) {
      const auto& [pose, bricks] = expected.visits[i];
      const test::CutAnswer answer = test::cut_bricks(*cl, pose, bricks);
      ASSERT_EQ(answer.sums, expected.answers[i].sums) << "pose " << i;
      ASSERT_EQ(answer.outcomes, expected.answers[i].outcomes) << "pose " << i;
    }
    ASSERT_EQ(scene.bone.coverage, expected.scene.bone.coverage);
  }
}

TEST(RemovalCl, CutsWhatTheCppTwinCutsAtAThousandRandomPoses) {
  constexpr unsigned seed = 41;
  std::cout << "seed " << seed << '\n';
  const Expected expected(seed, {96, 88, 72}, 1000);
  EXPECT_GT(expected.changed, 500);
  test::on_every_device([&](const gpu::Device& device) { expect_the_same(expected, seed, device); });
}

TEST(RemovalCl, CutsTheSameWhereTheBoneIsInParts) {
  constexpr unsigned seed = 42;
  std::cout << "seed " << seed << '\n';
  for (const auto& [dims, largest_buffer_bytes, parts] : test::small_parts) {
    SCOPED_TRACE(std::to_string(parts) + " parts");
    const Expected expected(seed, dims, 200);
    EXPECT_GT(expected.changed, 100);
    test::on_every_device([&, limit = largest_buffer_bytes, count = parts](const gpu::Device& device) {
      expect_the_same(expected, seed, device, limit, count);
    });
  }
}

}  // namespace
}  // namespace ream::collide
