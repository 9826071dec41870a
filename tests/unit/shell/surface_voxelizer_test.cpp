#include "shell/surface_voxelizer.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <queue>

#include "core/error.hpp"
#include "support/seed.hpp"
#include "support/test_meshes.hpp"

namespace ream::shell {
namespace {

using test::box_mesh;
using test::only_triangle;
using test::random_triangles;

SurfaceVoxels voxelized(const TriangleMesh& mesh, double size_mm, Separability separability) {
  SurfaceVoxels grid = surface_grid(mesh, size_mm);
  voxelize_surface_cpu(mesh, separability, grid);
  return grid;
}

Mat3 some_rotation(double a) { return rotation_from_small_vector(Vec3(0.3 * a, -0.5 * a, 0.2 * a)); }

/// Independent reference: the 13-axis separating-axis test of a triangle and a unit cell, in doubles. `slack`
/// widens (positive) or shrinks (negative) the cell, in cells.
bool triangle_meets_cell(const std::array<Vec3, 3>& triangle, const Vec3& centre, double slack) {
  const std::array<Vec3, 3> v = {triangle[0] - centre, triangle[1] - centre, triangle[2] - centre};
  const Vec3 half = Vec3::Constant(0.5 + slack);
  const std::array<Vec3, 3> edges = {v[1] - v[0], v[2] - v[1], v[0] - v[2]};
  std::vector<Vec3> axes = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ(), Vec3(edges[0].cross(edges[1]))};
  for (const Vec3& edge : edges)
    for (int k = 0; k < 3; ++k) axes.emplace_back(edge.cross(Vec3::Unit(k)));
  for (const Vec3& axis : axes) {
    const double a = axis.dot(v[0]), b = axis.dot(v[1]), c = axis.dot(v[2]);
    const double reach = half.dot(axis.cwiseAbs());
    if (std::min({a, b, c}) > reach || std::max({a, b, c}) < -reach) return false;
  }
  return true;
}

std::array<Vec3, 3> in_cells(const TriangleMesh& mesh, size_t triangle, const SurfaceVoxels& grid) {
  std::array<Vec3, 3> corners;
  for (size_t i = 0; i < 3; ++i)
    corners[i] =
        (mesh.vertices_mm[mesh.triangles[triangle][i]].cast<double>() - grid.origin_mm) / grid.size_mm;
  return corners;
}

template <class Visit>
void for_each_cell(const SurfaceVoxels& grid, Visit visit) {
  for (int w = 0; w < grid.dims.z(); ++w)
    for (int v = 0; v < grid.dims.y(); ++v)
      for (int u = 0; u < grid.dims.x(); ++u) visit(u, v, w);
}

/// Whether empty cells connect `from` to `to`, stepping to face neighbours or to all 26.
bool path_exists(const SurfaceVoxels& grid, const Vec3i& from, const Vec3i& to, bool all_neighbours) {
  const Vec3i dims = grid.dims;
  std::vector<char> seen(static_cast<size_t>(dims.x()) * static_cast<size_t>(dims.y() * dims.z()));
  const auto index = [&](const Vec3i& c) {
    return static_cast<size_t>(c.x() + dims.x() * (c.y() + dims.y() * c.z()));
  };
  std::queue<Vec3i> open;
  open.push(from);
  seen[index(from)] = 1;
  while (!open.empty()) {
    const Vec3i cell = open.front();
    open.pop();
    if (cell == to) return true;
    for (int n = 0; n < 27; ++n) {
      const Vec3i step(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
      if (!all_neighbours && step.cwiseAbs().sum() != 1) continue;
      const Vec3i next = cell + step;
      if ((next.array() < 0).any() || (next.array() >= dims.array()).any() || seen[index(next)]) continue;
      seen[index(next)] = 1;
      if (!grid.filled(next.x(), next.y(), next.z())) open.push(next);
    }
  }
  return false;
}

/// The grid of a mesh with `border` more empty cells all around.
SurfaceVoxels roomy_grid(const TriangleMesh& mesh, double size_mm, int border) {
  SurfaceVoxels grid = surface_grid(mesh, size_mm);
  grid.dims.array() += 2 * border;
  grid.origin_mm.array() -= border * size_mm;
  grid.words.assign(grid.word_index(0, 0, grid.dims.z()), 0);
  return grid;
}

TEST(SurfaceGrid, HoldsTheMeshWithHalfACellToSpare) {
  const SurfaceVoxels grid = surface_grid(box_mesh({1.0f, 2.0f, 3.0f}), 0.5);
  EXPECT_EQ(grid.dims, Vec3i(5, 9, 13));
  EXPECT_LT((grid.origin_mm - Vec3(-1.25, -2.25, -3.25)).norm(), 1e-12);
  EXPECT_EQ(grid.filled_cells(), 0u);
}

TEST(SurfaceGrid, RefusesImpossibleRequests) {
  const TriangleMesh box = box_mesh({1, 1, 1});
  for (const double size : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity(), 1e-7})
    EXPECT_THROW(surface_grid(box, size), Error) << size;
  EXPECT_THROW(surface_grid(TriangleMesh{}, 1.0), Error);
  TriangleMesh broken = box;
  broken.vertices_mm[0].x() = std::numeric_limits<float>::infinity();
  EXPECT_THROW(surface_grid(broken, 1.0), Error);
}

TEST(SurfaceVoxelizer, AxisAlignedBoxInCellCentresIsOneLayerThick) {
  const TriangleMesh box = box_mesh({5.0f, 5.0f, 5.0f});
  const size_t shell_cells = 11 * 11 * 11 - 9 * 9 * 9;
  EXPECT_EQ(voxelized(box, 1.0, Separability::six).filled_cells(), shell_cells);
  EXPECT_EQ(voxelized(box, 1.0, Separability::twenty_six).filled_cells(), shell_cells);
}

TEST(SurfaceVoxelizer, TwentySixIsTheSupercoverByAnIndependentTest) {
  for (const unsigned seed : {1u, 2u, 3u, 4u, 5u, 6u}) {
    std::mt19937 random(seed);
    std::cout << "seed " << seed << '\n';
    const TriangleMesh all = random_triangles(random, 64, 10.0f);
    for (size_t i = 0; i < all.triangles.size(); ++i) {
      const TriangleMesh mesh = only_triangle(all, i);
      SurfaceVoxels grid = surface_grid(mesh, 0.37);
      voxelize_surface_cpu(mesh, Separability::twenty_six, grid);
      const auto triangle = in_cells(mesh, 0, grid);
      for_each_cell(grid, [&](int u, int v, int w) {
        const Vec3 centre(u + 0.5, v + 0.5, w + 0.5);
        // Corners are rounded to float once, which moves them by less than 1e-5 cells here.
        const bool filled = grid.filled(u, v, w);
        EXPECT_TRUE(filled || !triangle_meets_cell(triangle, centre, -1e-5));
        EXPECT_TRUE(!filled || triangle_meets_cell(triangle, centre, 1e-3));
      });
    }
  }
}

TEST(SurfaceVoxelizer, SixMarksTheCellOfEveryCrossingBetweenFaceNeighbours) {
  std::mt19937 random(test::seed(11));
  const TriangleMesh all = random_triangles(random, 200, 10.0f);
  size_t crossings = 0;
  for (size_t i = 0; i < all.triangles.size(); ++i) {
    const TriangleMesh mesh = only_triangle(all, i);
    const SurfaceVoxels grid = voxelized(mesh, 0.15, Separability::six);
    const auto t = in_cells(mesh, 0, grid);
    const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]);
    for (int axis = 0; axis < 3; ++axis)
      for_each_cell(grid, [&](int u, int v, int w) {
        // Where the cell's central line along `axis` crosses the triangle, by barycentric coordinates.
        const Vec3 centre(u + 0.5, v + 0.5, w + 0.5);
        if (std::abs(normal[axis]) < 1e-6) return;
        const double along = normal.dot(t[0] - centre) / normal[axis];
        if (std::abs(along) > 0.5 - 1e-5) return;
        const Vec3 p = centre + along * Vec3::Unit(axis);
        for (size_t k = 0; k < 3; ++k) {
          const double inside = (t[(k + 1) % 3] - t[k]).cross(p - t[k]).dot(normal) / normal.squaredNorm();
          if (inside < 1e-5) return;
        }
        ++crossings;
        EXPECT_TRUE(grid.filled(u, v, w)) << "seed 11, triangle " << i;
      });
  }
  EXPECT_GT(crossings, 10000u);
}

TEST(SurfaceVoxelizer, TwentySixContainsSix) {
  std::mt19937 random(test::seed(21));
  const TriangleMesh mesh = random_triangles(random, 400, 20.0f);
  const SurfaceVoxels thin = voxelized(mesh, 0.23, Separability::six);
  const SurfaceVoxels thick = voxelized(mesh, 0.23, Separability::twenty_six);
  ASSERT_EQ(thin.words.size(), thick.words.size());
  for (size_t i = 0; i < thin.words.size(); ++i) ASSERT_EQ(thin.words[i] & ~thick.words[i], 0u);
  EXPECT_LT(thin.filled_cells(), thick.filled_cells());
}

TEST(SurfaceVoxelizer, ClosedSurfacesDoNotLeak) {
  for (int turn = 0; turn < 8; ++turn) {
    const TriangleMesh box =
        box_mesh({5.1f, 3.3f, 7.7f}).transformed({some_rotation(turn), Vec3(0.1 * turn, 0.0, 1.0)});
    for (const double size_mm : {0.4, 0.7}) {
      for (const bool all_neighbours : {false, true}) {
        SurfaceVoxels grid = roomy_grid(box, size_mm, 2);
        voxelize_surface_cpu(box, all_neighbours ? Separability::twenty_six : Separability::six, grid);
        const Vec3i inside = (grid.dims.cast<double>() / 2.0).cast<int>();
        ASSERT_FALSE(grid.filled(inside.x(), inside.y(), inside.z()));
        EXPECT_FALSE(path_exists(grid, Vec3i::Zero(), inside, all_neighbours)) << turn << ' ' << size_mm;
        EXPECT_TRUE(path_exists(grid, Vec3i::Zero(), grid.dims.array() - 1, all_neighbours));
      }
    }
  }
}

TEST(SurfaceVoxelizer, FacesOnCellBordersDoNotLeak) {
  const TriangleMesh box = box_mesh({4.0f, 4.0f, 4.0f});
  for (const bool all_neighbours : {false, true}) {
    SurfaceVoxels grid = roomy_grid(box, 1.0, 2);
    grid.origin_mm.array() = -6.0;
    voxelize_surface_cpu(box, all_neighbours ? Separability::twenty_six : Separability::six, grid);
    EXPECT_FALSE(path_exists(grid, Vec3i::Zero(), Vec3i(6, 6, 6), all_neighbours));
  }
}

TEST(SurfaceVoxelizer, MarksOnlyInsideAGridThatIsTooSmall) {
  const TriangleMesh box = box_mesh({50.0f, 50.0f, 50.0f});
  SurfaceVoxels grid;
  grid.dims = {40, 33, 7};
  grid.size_mm = 1.0;
  grid.origin_mm = {40.0, 40.0, 40.0};
  grid.words.assign(grid.word_index(0, 0, grid.dims.z()), 0);
  voxelize_surface_cpu(box, Separability::six, grid);
  EXPECT_TRUE(grid.filled(9, 5, 5) || grid.filled(10, 5, 5));
  EXPECT_FALSE(grid.filled(20, 5, 5));
}

}  // namespace
}  // namespace ream::shell
