#include "collide/removal_cl.hpp"

#include <algorithm>

#include "collide/narrow_phase_cl.hpp"
#include "every_device.hpp"
#include "reaming_scene.hpp"
#include "support/cut_bricks.hpp"

namespace ream::collide {
namespace {

constexpr LaunchShape shapes[] = {{1, 1}, {16, 1}, {3, 8}, {2, 64}};
constexpr int pose_count = 1000;

/// Poses that go deeper and deeper, so that each of them finds something to cut, with the bricks around them.
struct Visit {
  QuantisedPose pose;
  std::vector<uint32_t> bricks;
};

std::vector<Visit> random_visits(const test::ReamingScene& scene, unsigned seed) {
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

TEST(RemovalCl, CutsWhatTheCppTwinCutsAtAThousandRandomPoses) {
  constexpr unsigned seed = 41;
  std::cout << "seed " << seed << '\n';
  test::ReamingScene cpu_scene(seed);
  const auto visits = random_visits(cpu_scene, seed);
  const auto cpu = make_removal_cpu({cpu_scene.profile, cpu_scene.bone});
  std::vector<test::CutAnswer> expected;
  size_t changed = 0;
  for (const Visit& visit : visits) {
    expected.push_back(test::cut_bricks(*cpu, visit.pose, visit.bricks));
    changed += expected.back().sums.changed_bricks != 0;
  }
  EXPECT_GT(changed, pose_count / 2);
  test::on_every_device([&](const gpu::Device& device) {
    for (const LaunchShape shape : shapes) {
      SCOPED_TRACE(std::to_string(shape.groups) + " groups of " + std::to_string(shape.lanes));
      test::ReamingScene scene(seed);
      const auto cl = make_removal_cl({scene.profile, scene.bone},
                                      std::make_shared<BoneBuffers>(device, scene.bone), shape);
      for (size_t i = 0; i < visits.size(); ++i) {
        const test::CutAnswer answer = test::cut_bricks(*cl, visits[i].pose, visits[i].bricks);
        ASSERT_EQ(answer.sums, expected[i].sums) << "pose " << i;
        ASSERT_EQ(answer.outcomes, expected[i].outcomes) << "pose " << i;
      }
      ASSERT_EQ(scene.bone.coverage, cpu_scene.bone.coverage);
    }
  });
}

}  // namespace
}  // namespace ream::collide
