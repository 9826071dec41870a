#include "collide/removal_cl.hpp"

#include <numeric>

#include "collide/narrow_phase_cl.hpp"
#include "every_device.hpp"
#include "reaming_scene.hpp"
#include "support/cut_bricks.hpp"

namespace ream::collide {
namespace {

constexpr LaunchShape shapes[] = {{16, 1}, {5, 32}};

TEST(RemovalCl, CutsWhatTheCppTwinCutsAtRandomPoses) {
  std::cout << "seed 41\n";
  test::on_every_device([&](const gpu::Device& device) {
    for (const LaunchShape shape : shapes) {
      test::ReamingScene cpu_scene(41), cl_scene(41);
      const auto cpu = make_removal_cpu({cpu_scene.profile, cpu_scene.bone});
      const auto buffers = std::make_shared<BoneBuffers>(device, cl_scene.bone);
      const auto cl = make_removal_cl({cl_scene.profile, cl_scene.bone}, buffers, shape);
      std::mt19937 random(41);
      std::vector<uint32_t> bricks(cpu_scene.bone.grid.brick_count());
      std::iota(bricks.begin(), bricks.end(), 0u);
      uint32_t changed = 0;
      for (int i = 0; i < 8; ++i) {
        const QuantisedPose pose = cpu_scene.random_pose(random);
        std::shuffle(bricks.begin(), bricks.end(), random);
        const test::CutAnswer expected = test::cut_bricks(*cpu, pose, bricks);
        const test::CutAnswer answer = test::cut_bricks(*cl, pose, bricks);
        ASSERT_EQ(answer.sums, expected.sums) << "pose " << i;
        ASSERT_EQ(answer.outcomes, expected.outcomes);
        ASSERT_EQ(cl_scene.bone.coverage, cpu_scene.bone.coverage);
        changed += expected.sums.changed_bricks;
      }
      EXPECT_GT(changed, 100u);
    }
  });
}

/// One tick as the step does it: contact, due bricks, cut, retire.
struct Reaming {
  Reaming(test::ReamingScene& scene_, std::unique_ptr<NarrowPhase> narrow, std::unique_ptr<Removal> cutter)
      : scene(scene_),
        narrow_phase(std::move(narrow)),
        removal(std::move(cutter)),
        schedule(scene.profile, scene.bone) {}

  void tick(const QuantisedPose& pose, const Voi& voi) {
    ASSERT_TRUE(narrow_phase->contact(pose, voi, contact));
    const std::span<const uint32_t> due = schedule.due(pose);
    const test::CutAnswer answer = test::cut_bricks(*removal, pose, due);
    for (size_t i = 0; i < due.size(); ++i) schedule.cut_done(i, answer.outcomes[i]);
    sums = answer.sums;
  }

  test::ReamingScene& scene;
  std::unique_ptr<NarrowPhase> narrow_phase;
  std::unique_ptr<Removal> removal;
  RemovalSchedule schedule;
  ContactSums contact;
  RemovalSums sums;
};

TEST(RemovalCl, AWholeShortReamingIsTheSameTickByTick) {
  test::on_every_device([&](const gpu::Device& device) {
    test::ReamingScene cpu_scene(42), cl_scene(42);
    const LaunchShape shape = LaunchShape::fitting(device);
    const auto buffers = std::make_shared<BoneBuffers>(device, cl_scene.bone);
    Reaming cpu(cpu_scene, make_narrow_phase_cpu(cpu_scene.contact_input()),
                make_removal_cpu({cpu_scene.profile, cpu_scene.bone}));
    Reaming cl(cl_scene, make_narrow_phase_cl(cl_scene.contact_input(), buffers, shape),
               make_removal_cl({cl_scene.profile, cl_scene.bone}, buffers, shape));
    const uint64_t untouched = cpu_scene.bone.coverage_hash();
    for (int i = 0; i < 400; ++i) {
      const double t = 0.0015 * i;
      const QuantisedPose pose =
          cpu_scene.pose(-1.0 + 8.0 * t, Vec3(0.2 * t, -0.1 * t, 3.0 * t), Vec3(1.5 * t, -t, 0.0));
      const Voi voi = cpu_scene.voi(pose);
      cpu.tick(pose, voi);
      cl.tick(pose, voi);
      ASSERT_EQ(cl.contact, cpu.contact) << "tick " << i;
      ASSERT_EQ(cl.sums, cpu.sums) << "tick " << i;
    }
    EXPECT_EQ(cl_scene.bone.coverage, cpu_scene.bone.coverage);
    EXPECT_NE(cpu_scene.bone.coverage_hash(), untouched);
  });
}

}  // namespace
}  // namespace ream::collide
