#include "ct/build/surroundings.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <filesystem>

#include "ct/phantom/phantom_case.hpp"
#include "support/temporary_folder.hpp"

namespace ream::ct {
namespace {

/// A strip of four triangles along x, from 0 to 4.
TriangleMesh strip() {
  TriangleMesh mesh;
  for (int x = 0; x <= 4; ++x)
    for (int y = 0; y <= 1; ++y) {
      mesh.vertices_mm.emplace_back(static_cast<float>(x), static_cast<float>(y), 0.5f);
      mesh.normals.emplace_back(0.0f, 0.0f, 1.0f);
    }
  for (uint32_t x = 0; x < 4; ++x) mesh.triangles.push_back({2 * x, 2 * x + 2, 2 * x + 1});
  return mesh;
}

TEST(Surroundings, AreWhatDoesNotLieInTheGridsBoxAndNoLooseCorners) {
  voxel::VoxelGrid grid;
  grid.dims = {16, 16, 16};
  grid.spacing_mm = Vec3::Constant(0.25);
  grid.world_from_grid.translation_mm = {0.5, -1.5, -1.5};
  const TriangleMesh around = surroundings_of(strip(), grid);
  // In the box, a millimetre within its sides, are the corners at x = 2 and 3: of four triangles one lies in
  // it.
  EXPECT_EQ(around.triangles.size(), 3u);
  EXPECT_EQ(around.vertices_mm.size(), 8u);
  EXPECT_EQ(around.normals.size(), around.vertices_mm.size());
  for (const auto& triangle : around.triangles)
    for (const uint32_t corner : triangle) ASSERT_LT(corner, around.vertices_mm.size());
  grid.world_from_grid.translation_mm = {-100, 0, 0};
  EXPECT_EQ(surroundings_of(strip(), grid).triangles.size(), 4u);
}

/// A plate that crosses the box: its upper side stands out most at the box's side, and by nothing far from
/// it.
TEST(Surroundings, CoverTheSeamAlongTheGridsSides) {
  voxel::VoxelGrid grid;
  grid.dims = {16, 16, 16};
  grid.spacing_mm = Vec3::Constant(1.0);
  TriangleMesh plate;
  constexpr int steps = 40;
  for (int i = 0; i <= steps; ++i)
    for (int k = 0; k <= steps; ++k)
      plate.vertices_mm.emplace_back(static_cast<float>(i), static_cast<float>(k - 12), 8.0f);
  for (uint32_t i = 0; i < steps; ++i)
    for (uint32_t k = 0; k < steps; ++k) {
      const uint32_t a = i * (steps + 1) + k, b = a + steps + 1;
      plate.triangles.push_back({a, b, a + 1});
      plate.triangles.push_back({b, b + 1, a + 1});
    }
  const TriangleMesh around = surroundings_of(plate, grid);
  float highest = 0.0f;
  for (const Vec3f& vertex : around.vertices_mm) {
    EXPECT_GE(vertex.z(), 8.0f);
    const bool far = vertex.x() > 18.5f || vertex.y() > 18.5f || vertex.y() < -2.5f;
    EXPECT_TRUE(!far || vertex.z() == 8.0f) << vertex.transpose();
    const bool at_side = std::abs(vertex.x() - 16.0f) < 0.01f && vertex.y() > 1.0f && vertex.y() < 15.0f;
    EXPECT_TRUE(!at_side || vertex.z() > 8.2f) << vertex.transpose();
    highest = std::max(highest, vertex.z());
  }
  EXPECT_LE(highest, 8.25f);
}

TEST(Surroundings, AreNotDrawnWhereAReamerComesTo) {
  case_::Plan plan;
  plan.axis_direction = {1, 0, 0};
  voxel::VoxelGrid grid;
  grid.dims = {16, 16, 16};
  grid.spacing_mm = Vec3::Constant(0.5);
  grid.world_from_grid.translation_mm = {-2, -2, -2};
  const auto left = [&](double entry_x, double beside) {
    plan.entry_mm = {entry_x, beside, 0};
    return beyond_reach(strip(), plan, grid).triangles.size();
  };
  EXPECT_EQ(left(0, 0), 0u);    // in the bone's face
  EXPECT_EQ(left(20, 0), 0u);   // before it
  EXPECT_EQ(left(-20, 0), 4u);  // far under it
  EXPECT_EQ(left(-10, 0), 3u);  // the first triangle ends 12 mm under it
  EXPECT_EQ(left(0, 40), 4u);   // beside it
  // Beyond the grid's sides nothing is ever cut: what lies there is drawn up to them.
  grid.world_from_grid.translation_mm.x() = 1.5;
  EXPECT_EQ(left(0, 0), 2u);
  // One that lies turned: its y runs against the world's x, from 4.5 to 0.5.
  grid.dims = {16, 4, 16};
  grid.spacing_mm = Vec3::Constant(1.0);
  grid.world_from_grid.rotation << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  grid.world_from_grid.translation_mm = {4.5, -2, -8};
  EXPECT_EQ(left(0, 0), 1u);
}

TEST(Surroundings, AreKeptReplacedAndRemoved) {
  const test::TemporaryFolder folder;
  EXPECT_TRUE(kept_surroundings(folder.path()).triangles.empty());
  keep_surroundings(strip(), case_::Side::left, folder.path());
  const TriangleMesh kept = kept_surroundings(folder.path());
  EXPECT_EQ(kept.triangles.size(), 4u);
  EXPECT_EQ(kept.normals.size(), kept.vertices_mm.size());
  keep_surroundings({}, case_::Side::left, folder.path());
  EXPECT_TRUE(folder.entries().empty());
  keep_surroundings({}, case_::Side::left, folder.path());
  folder.write(surroundings_file, "ply\nnothing of the kind");
  EXPECT_TRUE(kept_surroundings(folder.path()).triangles.empty());
}

/// The rest of the demo's scapula goes on where the bone that is reamed ends, and is nowhere in its box.
TEST(Surroundings, OfTheDemoAreTheRestOfItsScapula) {
  const test::TemporaryFolder data;
  const case_::Case demo = load_or_make_demo_case(data.path());
  const auto file = data.path() / "cases" / "demo" / surroundings_file;
  const TriangleMesh around = kept_surroundings(file.parent_path());
  ASSERT_EQ(around.normals.size(), around.vertices_mm.size());
  // Outwards: triangles are counter-clockwise seen from outside, and normals agree with them but in creases.
  size_t opposed = 0;
  for (const auto& [a, b, c] : around.triangles) {
    const Vec3f& corner = around.vertices_mm[a];
    const Vec3f area = (around.vertices_mm[b] - corner).cross(around.vertices_mm[c] - corner);
    opposed += area.dot(around.normals[a]) < 0.0f;
  }
  EXPECT_LT(opposed, around.triangles.size() / 500);
  EXPECT_GT(around.triangles.size(), 5000u);
  const Aabb grid = demo.bone.grid.bounds_mm();
  const Pose grid_from_world = demo.bone.grid.world_from_grid.inverse();
  double nearest_mm = 1e9;
  for (const auto& triangle : around.triangles) {
    Vec3 centre = Vec3::Zero();
    for (const uint32_t corner : triangle)
      centre += grid_from_world.point(around.vertices_mm[corner].cast<double>()) / 3.0;
    const Vec3 beyond = (grid.min - centre).cwiseMax(centre - grid.max).cwiseMax(0.0);
    nearest_mm = std::min(nearest_mm, beyond.norm());
    ASSERT_FALSE(grid.grown(-2.5).contains(centre)) << centre.transpose();
  }
  EXPECT_EQ(nearest_mm, 0.0);
  // The blade's lower tip is there: the scapula is over ten centimetres high.
  const Vec3 size = around.bounds().max - around.bounds().min;
  EXPECT_GT(size.z(), 120.0);
  EXPECT_GT(size.x(), 100.0);

  // A data folder of before gets them, too; somebody's own case of that name does not.
  std::filesystem::remove(file);
  load_or_make_demo_case(data.path());
  EXPECT_TRUE(std::filesystem::exists(file));
  std::filesystem::remove(file);
  case_::Case own = demo;
  own.source = "CT";
  case_::save_bone(own, file.parent_path());
  load_or_make_demo_case(data.path());
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST(Surroundings, OfALeftShoulderAreTheMirrorImage) {
  PhantomParams right, left;
  left.side = case_::Side::left;
  const Aabb a = scapula_surface(right, 2.5).bounds(), b = scapula_surface(left, 2.5).bounds();
  EXPECT_NEAR(a.min.x(), -b.max.x(), 0.01);
  EXPECT_NEAR(a.max.x(), -b.min.x(), 0.01);
  EXPECT_NEAR(a.min.y(), b.min.y(), 0.01);
  EXPECT_GT(scapula_surface(left, 2.5).volume_mm3(), 0.0);
}

}  // namespace
}  // namespace ream::ct
