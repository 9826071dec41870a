#include "every_device.hpp"
#include "geometry/mesh_io.hpp"
#include "support/awkward_triangles.hpp"
#include "support/seed.hpp"
#include "support/shared_data.hpp"
#include "support/test_meshes.hpp"
#include "voxelizer/voxelizer_cl.hpp"

namespace ream::voxelizer {
namespace {

std::vector<std::vector<uint32_t>> rows_of(const VoxelSet& set) {
  std::vector<std::vector<uint32_t>> rows;
  for (int w = 0; w < set.grid().dims.z(); ++w)
    for (int v = 0; v < set.grid().dims.y(); ++v)
      set.read_row(v, w, rows.emplace_back(set.grid().words_per_row()));
  return rows;
}

std::vector<Request> requests(bool with_solid) {
  std::vector<Request> list(2);
  list[1].separability = Separability::six;
  if (with_solid) {
    list.push_back({.surface = false, .solid = true});
    list.push_back({.surface = true, .separability = Separability::six, .solid = true});
  }
  return list;
}

void expect_equal_sets(const TriangleMesh& mesh, const RasterGrid& grid, bool with_solid,
                       size_t max_dense_bytes = default_dense_bytes) {
  std::vector<VoxelSet> expected;
  for (const Request& request : requests(with_solid))
    Voxelizer(2).voxelize(mesh, request, expected.emplace_back(grid, max_dense_bytes));
  ASSERT_GT(expected.front().filled(), 0u);
  test::on_every_device([&](const gpu::Device& device) {
    if (!device.knows_doubles) return;
    const gpu::Queue queue(device);
    VoxelizerCl voxelizer(queue);
    for (size_t i = 0; i < expected.size(); ++i) {
      VoxelSet set(grid, max_dense_bytes);
      voxelizer.voxelize(mesh, requests(with_solid)[i], set);
      EXPECT_EQ(set.filled(), expected[i].filled()) << "request " << i;
      EXPECT_EQ(rows_of(set), rows_of(expected[i])) << "request " << i;
    }
  });
}

TriangleMesh awkward_soup(std::mt19937& random, int count, const Vec3i& dims) {
  TriangleMesh mesh;
  for (int i = 0; i < count; ++i) {
    const auto first = static_cast<uint32_t>(mesh.vertices_mm.size());
    for (const Vec3f& corner : test::awkward_triangle(random, i, dims).corners)
      mesh.vertices_mm.push_back(corner);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

TEST(VoxelizerCl, AwkwardTrianglesMarkTheSameVoxels) {
  const RasterGrid grid{{230, 190, 170}, Vec3::Zero(), Vec3::Ones()};
  std::mt19937 random(test::seed());
  for (const int count : {1200, 1200, 1, 15, 17})
    expect_equal_sets(awkward_soup(random, count, grid.dims), grid, false);
}

TEST(VoxelizerCl, SolidsAreTheSameVoxels) {
  const TriangleMesh box = test::box_mesh({7.0f, 5.0f, 6.0f});
  expect_equal_sets(box, grid_around(used_bounds(box, 1.0), {0.11, 0.23, 0.17}), true);
}

TEST(VoxelizerCl, GridsThatAreSmallerThanTheMeshAreTheSame) {
  const TriangleMesh box = test::box_mesh({50.0f, 50.0f, 50.0f});
  expect_equal_sets(box, {{40, 33, 70}, {40.0, 40.0, -30.0}, Vec3::Ones()}, true);
}

TEST(VoxelizerCl, SparseBricksHoldTheSameVoxels) {
  const TriangleMesh box = test::box_mesh({7.0f, 5.0f, 6.0f});
  expect_equal_sets(box, grid_around(used_bounds(box, 1.0), Vec3::Constant(0.09)), true, 0);
}

TEST(VoxelizerCl, MeshesOfOthersAreTheSameVoxels) {
  for (const char* name : {"mesh/reamer_4006.stl", "mesh/teapot_894.stl", "mesh/bunny_16301.ply",
                           "mesh/scapula_right_openforge_28106.stl"}) {
    REAM_SKIP_WITHOUT(test::shared_data(name));
    const TriangleMesh mesh = load_mesh(test::shared_data(name));
    const Aabb box = used_bounds(mesh, 1.0);
    expect_equal_sets(mesh, grid_around(box, Vec3::Constant((box.max - box.min).maxCoeff() / 150.0)), true);
  }
}

}  // namespace
}  // namespace ream::voxelizer
