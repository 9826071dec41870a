#include "every_device.hpp"
#include "shell/surface_voxelizer_cl.hpp"
#include "support/test_meshes.hpp"

namespace ream::shell {
namespace {

void expect_equal_bits(const TriangleMesh& mesh, double size_mm) {
  for (const Separability separability : {Separability::six, Separability::twenty_six}) {
    SurfaceVoxels expected = surface_grid(mesh, size_mm);
    SurfaceVoxels blank = expected;
    voxelize_surface_cpu(mesh, separability, expected);
    ASSERT_GT(expected.filled_cells(), 0u);
    test::on_every_device([&](const gpu::Device& device) {
      const gpu::Queue queue(device);
      SurfaceVoxels grid = blank;
      SurfaceVoxelizerCl(queue).voxelize(mesh, separability, grid);
      EXPECT_EQ(grid.words, expected.words);
    });
  }
}

TEST(SurfaceVoxelizerCl, RandomTrianglesGiveTheSameBits) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    std::cout << "seed " << seed << '\n';
    std::mt19937 random(seed);
    expect_equal_bits(test::random_triangles(random, 500, 30.0f), 0.21);
  }
}

TEST(SurfaceVoxelizerCl, AwkwardTriangleCountsGiveTheSameBits) {
  std::mt19937 random(4);
  for (const int count : {1, 15, 16, 17, 31})
    expect_equal_bits(test::random_triangles(random, count, 5.0f), 0.5);
}

TEST(SurfaceVoxelizerCl, LargeAndDegenerateTrianglesGiveTheSameBits) {
  expect_equal_bits(test::box_mesh({40.0f, 0.01f, 25.0f}), 0.2);
  TriangleMesh lines = test::box_mesh({3.0f, 3.0f, 3.0f});
  for (auto& triangle : lines.triangles) triangle[2] = triangle[1];
  expect_equal_bits(lines, 0.1);
}

TEST(SurfaceVoxelizerCl, AddsToCellsThatAreMarkedAlready) {
  const TriangleMesh box = test::box_mesh({2.0f, 2.0f, 2.0f});
  test::on_every_device([&](const gpu::Device& device) {
    const gpu::Queue queue(device);
    SurfaceVoxels grid = surface_grid(box, 0.5);
    grid.words.assign(grid.words.size(), 0x01010101u);
    SurfaceVoxels expected = grid;
    voxelize_surface_cpu(box, Separability::six, expected);
    SurfaceVoxelizerCl(queue).voxelize(box, Separability::six, grid);
    EXPECT_EQ(grid.words, expected.words);
  });
}

}  // namespace
}  // namespace ream::shell
