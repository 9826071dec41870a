#include "surface/marching_cubes.hpp"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <set>

#include "geometry/vec.hpp"

namespace ream::surface {
namespace {

bool filled_at(int filled, const std::array<int, 3>& corner) {
  return ((filled >> (corner[0] | corner[1] << 1 | corner[2] << 2)) & 1) != 0;
}

Vec3 middle(int edge) {
  const CellEdge e = cell_edge(edge);
  Vec3 p(e.lower_corner[0], e.lower_corner[1], e.lower_corner[2]);
  p[e.axis] += 0.5;
  return p;
}

TEST(MarchingCubes, UsesExactlyTheEdgesThatTheSurfaceCrosses) {
  for (int filled = 0; filled < 256; ++filled) {
    std::set<int> used, crossed;
    const CellCase& cell = cell_cases()[static_cast<size_t>(filled)];
    for (size_t t = 0; t < cell.triangle_count; ++t)
      used.insert(cell.triangles[t].begin(), cell.triangles[t].end());
    for (int edge = 0; edge < 12; ++edge) {
      const CellEdge e = cell_edge(edge);
      std::array<int, 3> upper = e.lower_corner;
      upper[static_cast<size_t>(e.axis)] = 1;
      if (filled_at(filled, e.lower_corner) != filled_at(filled, upper)) crossed.insert(edge);
    }
    EXPECT_EQ(used, crossed) << filled;
  }
}

TEST(MarchingCubes, OneFilledCornerIsCutOffFacingAway) {
  for (int corner = 0; corner < 8; ++corner) {
    const CellCase& cell = cell_cases()[static_cast<size_t>(1 << corner)];
    ASSERT_EQ(cell.triangle_count, 1);
    const Vec3 a = middle(cell.triangles[0][0]), b = middle(cell.triangles[0][1]),
               c = middle(cell.triangles[0][2]);
    const Vec3 position(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
    EXPECT_GT((b - a).cross(c - a).dot(a - position), 0.0);
  }
}

TEST(MarchingCubes, FilledCornersAcrossAFaceStayApartAndEmptyOnesJoin) {
  EXPECT_EQ(cell_cases()[0b00001001].triangle_count, 2);
  EXPECT_EQ(cell_cases()[0b11110110].triangle_count, 4);
}

TEST(MarchingCubes, NothingInEmptyAndFullCells) {
  EXPECT_EQ(cell_cases()[0].triangle_count, 0);
  EXPECT_EQ(cell_cases()[255].triangle_count, 0);
}

}  // namespace
}  // namespace ream::surface
