#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "bench/baselines/flat_kernel.hpp"
#include "bench/baselines/thesis_mesher.hpp"
#include "bench/baselines/thesis_voxelizer.hpp"
#include "bench/baselines/yau.hpp"
#include "bench/baselines/zheng.hpp"
#include "gpu/queue.hpp"
#include "shell/tool.hpp"
#include "support/random_bone.hpp"
#include "support/random_pose.hpp"
#include "support/seed.hpp"
#include "voxelizer/voxel_set.hpp"

// A baseline that finds the wrong points proves nothing about speed.
namespace ream::test {
namespace {

constexpr uint32_t baselines_seed = 20180;

/// A small random bone and a reamer, on every device there is.
struct Scene {
  explicit Scene(std::mt19937& random)
      : bone(random_bone(random, {48, 40, 56}, 0.3)),
        point_shell(shell::make_point_shell(shell::make_tool("ellipse 8,5 nipple 2,3"), 0.4)),
        codes(bench::morton_shell(point_shell)) {
    bone.grid.spacing_mm = {0.5, 0.45, 0.4};
    voxmap = bench::voxmap_of(bone);
  }

  QuantisedPose pose(std::mt19937& random) const {
    Pose pose = random_pose(random, 0.0);
    pose.translation_mm = bone.grid.bounds_mm().centre() + random_vector(random, 12.0);
    return quantised(pose);
  }

  bool filled(const Vec3i& voxel) const {
    return bone.grid.contains(voxel) && bone.coverage[bone.grid.index(voxel)] >= 128;
  }
  /// In doubles and by the bone's own index; `near_border` counts points that rounding may put into either
  /// voxel.
  int64_t brute_force_inside(const QuantisedPose& q, int64_t& near_border) const {
    const Pose grid_from_tool = dequantised(q);
    int64_t inside = 0;
    near_border = 0;
    for (const auto& p : point_shell.points) {
      const Vec3 at = grid_from_tool.point(point_shell.cell_centre_mm(p.morton));
      inside += filled(bone.grid.voxel_at(at));
      const Vec3 voxels = (at.array() / bone.grid.spacing_mm.array()).matrix();
      near_border += ((voxels.array() - voxels.array().round()).abs() < 1e-4).any();
    }
    return inside;
  }

  voxel::BoneModel bone;
  shell::PointShell point_shell;
  bench::MortonShell codes;
  bench::Voxmap voxmap;
};

template <class Check>
void on_every_queue(Check check) {
  const std::vector<gpu::Device> devices = gpu::list_devices();
  ASSERT_FALSE(devices.empty()) << "no OpenCL device: install pocl-opencl-icd";
  for (const gpu::Device& device : devices) {
    SCOPED_TRACE(device.name + ", seed " + std::to_string(test::seed(baselines_seed)));
    const gpu::Queue queue(device);
    check(queue);
  }
}

TEST(Baselines, VoxmapIsTheBoneInRowOrder) {
  std::mt19937 random(test::seed(baselines_seed));
  const Scene s(random);
  const Vec3i dims = s.bone.grid.dims;
  Aabb box;
  size_t row = 0;
  for (int w = 0; w < dims.z(); ++w)
    for (int v = 0; v < dims.y(); ++v)
      for (int u = 0; u < dims.x(); ++u, ++row) {
        const Vec3i at(u, v, w);
        const int expected = s.filled(at) ? std::max<int>(s.bone.density[s.bone.grid.index(at)], 1) : 0;
        ASSERT_EQ(s.voxmap.gray[row], expected) << at.transpose();
        if (!s.filled(at)) continue;
        box.include((at.cast<double>().array() * s.bone.grid.spacing_mm.array()).matrix());
        box.include(((at.cast<double>().array() + 1.0) * s.bone.grid.spacing_mm.array()).matrix());
      }
  EXPECT_EQ(s.voxmap.bone_box_mm.min, box.min);
  EXPECT_EQ(s.voxmap.bone_box_mm.max, box.max);
}

TEST(Baselines, FlatKernelCountsAsABruteForceSearchDoes) {
  std::mt19937 random(test::seed(baselines_seed));
  Scene s(random);
  int64_t total = 0;
  for (int i = 0; i < 100; ++i) {
    const QuantisedPose pose = s.pose(random);
    int64_t near_border = 0;
    const int64_t expected = s.brute_force_inside(pose, near_border);
    const bench::FlatSums sums = bench::flat_contact_cpu(s.voxmap, s.codes, pose);
    EXPECT_LE(std::abs(sums.inside - expected), near_border)
        << "seed " << test::seed(baselines_seed) << " case " << i;
    EXPECT_EQ(sums, bench::flat_contact_cpu(s.voxmap, s.codes, pose, {.use_voi = false})) << "case " << i;
    total += expected;
  }
  EXPECT_GT(total, 10000);
}

TEST(Baselines, FlatKernelGivesTheSumsOfItsPlainForm) {
  on_every_queue([](const gpu::Queue& queue) {
    std::mt19937 random(test::seed(baselines_seed));
    Scene s(random);
    bench::FlatKernel kernel(queue, s.voxmap, s.codes);
    for (int i = 0; i < 50; ++i) {
      const QuantisedPose pose = s.pose(random);
      const bench::FlatSums expected = bench::flat_contact_cpu(s.voxmap, s.codes, pose);
      EXPECT_EQ(kernel.contact(pose), expected) << "case " << i;
      EXPECT_EQ(kernel.contact(pose, {.use_voi = false}), expected) << "case " << i;
    }
  });
}

TEST(Baselines, TheFairFormGivesTheSumsOfThePlainOne) {
  std::mt19937 random(test::seed(baselines_seed));
  Scene s(random);
  bench::FlatThreads threads(s.voxmap, s.codes);
  int64_t total = 0;
  for (int i = 0; i < 200; ++i) {
    const QuantisedPose pose = s.pose(random);
    const bench::FlatSums expected = bench::flat_contact_cpu(s.voxmap, s.codes, pose);
    EXPECT_EQ(threads.contact(pose), expected) << "case " << i;
    total += expected.inside;
  }
  EXPECT_GT(total, 10000);
}

TEST(Baselines, HashMapsOnTwoThreadsNumberTheSameNodes) {
  std::vector<bench::VoxelRow> rows;
  std::mt19937 random(test::seed(baselines_seed));
  for (int i = 0; i < 2000; ++i)
    rows.push_back({{0.5f * static_cast<float>(random() % 12), 0.5f * static_cast<float>(random() % 12),
                     0.5f * static_cast<float>(random() % 12)},
                    1.0f});
  const auto nodes = bench::nodes_of(rows, Vec3::Constant(0.5));
  std::vector<uint32_t> one, two;
  EXPECT_EQ(bench::index_by_two_hash_maps(nodes, two).nodes, bench::index_by_hash_map(nodes, one).nodes);
  std::map<uint32_t, uint32_t> other_number;
  for (size_t i = 0; i < nodes.size(); ++i)
    EXPECT_EQ(other_number.emplace(one[i], two[i]).first->second, two[i]) << i;
  std::set<uint32_t> numbers(two.begin(), two.end());
  EXPECT_EQ(numbers.size(), other_number.size());
  EXPECT_EQ(*numbers.rbegin() + 1, numbers.size());
}

TEST(Baselines, TrianglesOnTwoThreadsMarkTheSameVoxels) {
  const TriangleMesh mesh = shell::revolve(shell::make_tool("ellipse 8,5 nipple 2,3").profile, 48);
  const voxelizer::RasterGrid grid =
      voxelizer::grid_around(voxelizer::used_bounds(mesh, 1.0), Vec3::Constant(0.3));
  const std::vector<float> corners = bench::thesis_corners(mesh, grid);
  std::vector<uint32_t> serial(voxelizer::VoxelSet(grid).word_count(), 0), threads = serial;
  bench::set_up_once_serial(corners, grid, serial);
  bench::set_up_once_threads(corners, grid, threads);
  EXPECT_EQ(threads, serial);
  EXPECT_GT(std::count_if(serial.begin(), serial.end(), [](uint32_t word) { return word != 0; }), 100);
}

TEST(Baselines, FlatForcesPointToTheMiddleOfTheTool) {
  std::mt19937 random(test::seed(baselines_seed));
  Scene s(random);
  const QuantisedPose pose = s.pose(random);
  std::vector<uint8_t> inside;
  const bench::FlatSums sums = bench::flat_contact_cpu(s.voxmap, s.codes, pose, {}, &inside);
  EXPECT_EQ(std::accumulate(inside.begin(), inside.end(), 0), sums.inside);
  const Pose grid_from_tool = dequantised(pose);
  const Vec3 middle = s.codes.box_mm.centre();
  Vec3 force = Vec3::Zero();
  for (size_t i = 0; i < inside.size(); ++i) {
    if (!inside[i]) continue;
    const Vec3 p = s.point_shell.cell_centre_mm(s.codes.codes[i]);
    const Vec3i voxel = s.bone.grid.voxel_at(grid_from_tool.point(p));
    const double gray = std::max<int>(s.bone.density[s.bone.grid.index(voxel)], 1);
    force += gray / 255.0 * 1000.0 * (middle - p) / s.codes.box_mm.half_size().norm();
  }
  for (int i = 0; i < 3; ++i) {
    // Each elemental force loses less than one unit to truncation.
    EXPECT_NEAR(sums.force[static_cast<size_t>(i)], force[i], sums.inside)
        << "seed " << test::seed(baselines_seed);
  }
}

TEST(Baselines, DecayTakesGrayFromCollidedVoxelsOnly) {
  std::mt19937 random(test::seed(baselines_seed));
  Scene s(random);
  const std::vector<uint8_t> before = s.voxmap.gray;
  const QuantisedPose pose = s.pose(random);
  const bench::FlatSums first = bench::flat_contact_cpu(s.voxmap, s.codes, pose, {.decay = 255});
  EXPECT_GT(first.inside, 0);
  EXPECT_EQ(bench::flat_contact_cpu(s.voxmap, s.codes, pose).inside, 0);
  size_t changed = 0;
  for (size_t i = 0; i < before.size(); ++i) changed += before[i] != s.voxmap.gray[i];
  EXPECT_GT(changed, 0u);
  EXPECT_LE(changed, static_cast<size_t>(first.inside));

  s.voxmap.gray = before;
  on_every_queue([&](const gpu::Queue& queue) {
    // Points that share a voxel race in the kernel, as in the thesis, but 255 levels take any voxel whole.
    bench::Voxmap voxmap = s.voxmap;
    bench::FlatKernel kernel(queue, voxmap, s.codes);
    kernel.contact(pose, {.decay = 255});
    EXPECT_EQ(kernel.contact(pose).inside, 0);
  });
}

TEST(Baselines, ZhengFindsTheSamePointsAsTheFlatKernel) {
  on_every_queue([](const gpu::Queue& queue) {
    std::mt19937 random(test::seed(baselines_seed));
    Scene s(random);
    bench::Zheng zheng(queue, s.voxmap, s.codes);
    for (int i = 0; i < 50; ++i) {
      const QuantisedPose pose = s.pose(random);
      std::vector<uint8_t> expected;
      const bench::FlatSums flat = bench::flat_contact_cpu(s.voxmap, s.codes, pose, {}, &expected);
      const bench::Zheng::Sums sums = zheng.contact(pose, true);
      EXPECT_EQ(zheng.inside(), expected.empty() ? std::vector<uint8_t>(s.codes.codes.size()) : expected)
          << "case " << i;
      EXPECT_EQ(sums.inside, flat.inside) << "case " << i;
      EXPECT_LE(zheng.collided_voxels(), flat.inside) << "case " << i;
      EXPECT_EQ(zheng.collided_voxels() > 0, flat.inside > 0) << "case " << i;
      for (size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(1000.0 * static_cast<double>(sums.force[k]), flat.force[k], flat.inside + 0.5)
            << "case " << i;
    }
  });
}

TEST(Baselines, YauCountsTheVoxelsWhoseCentresAreInTheCap) {
  on_every_queue([](const gpu::Queue& queue) {
    std::mt19937 random(test::seed(baselines_seed));
    const Scene s(random);
    const bench::ImplicitCap cap{8.0, 5.0, 4.0};
    bench::Yau yau(queue, s.voxmap, cap);
    int64_t total = 0;
    for (int i = 0; i < 50; ++i) {
      const QuantisedPose q = s.pose(random);
      const Pose tool_from_grid = dequantised(q).inverse();
      int64_t surely = 0, perhaps = 0, gray_sixteenths = 0;
      for (size_t voxel = 0; voxel < s.bone.coverage.size(); ++voxel) {
        const Vec3i at = s.bone.grid.coordinates(voxel);
        if (!s.filled(at)) continue;
        const Vec3 p = tool_from_grid.point(s.bone.grid.centre_mm(at));
        const double value = p.head<2>().squaredNorm() / 64.0 + (p.z() + 5.0) * (p.z() + 5.0) / 25.0;
        if (value > 1.0 + 1e-4 || p.z() < -4.0 - 1e-4) continue;
        ++perhaps;
        gray_sixteenths += std::max<int>(s.bone.density[s.bone.grid.index(at)], 1) / 16;
        surely += value < 1.0 - 1e-4 && p.z() > -4.0 + 1e-4;
      }
      const bench::Yau::Sums sums = yau.contact(q);
      EXPECT_GE(sums.collided, surely) << "case " << i;
      EXPECT_LE(sums.collided, perhaps) << "case " << i;
      EXPECT_NEAR(static_cast<double>(sums.gray_sixteenths), static_cast<double>(gray_sixteenths),
                  16.0 * static_cast<double>(perhaps - surely))
          << "case " << i;
      total += sums.collided;
    }
    EXPECT_GT(total, 10000);
  });
}

}  // namespace
}  // namespace ream::test
