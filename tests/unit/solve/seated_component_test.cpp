#include "solve/seated_component.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "core/error.hpp"

namespace ream::solve {
namespace {

constexpr double cell_mm = 0.5;
/// Of columns in the test's blocks: along x and y, where they begin in the box.
constexpr int length = 20, width = 6, first_x = 4, first_y = 5;
constexpr int component_from = 2, component_to = 5, bone_to = 14;

size_t index(const Vec3i& dims, int x, int y, int z) {
  return static_cast<size_t>(x + dims.x() * (y + dims.y() * z));
}

/// A block of bone that stands on the far end of its box, and a block on it; a joint of one cell between.
SeatedCells blocks(float bone_mpa) {
  SeatedCells cells;
  cells.dims = {length + 2 * first_x, width + 2 * first_y, bone_to};
  cells.cell_mm = cell_mm;
  const auto count = static_cast<size_t>(cells.dims.prod());
  const auto columns = static_cast<size_t>(cells.dims.x() * cells.dims.y());
  cells.bone_share.assign(count, 0.0f);
  cells.bone_mpa.assign(count, 0.0f);
  cells.component.assign(count, 0);
  cells.supported.assign(columns, 0);
  cells.normals.assign(columns, Vec3f::UnitZ());
  for (int y = first_y; y < first_y + width; ++y)
    for (int x = first_x; x < first_x + length; ++x) {
      cells.supported[index(cells.dims, x, y, 0)] = 1;
      for (int z = component_from; z < component_to; ++z) cells.component[index(cells.dims, x, y, z)] = 1;
      for (int z = component_to + 1; z < bone_to; ++z) {
        cells.bone_share[index(cells.dims, x, y, z)] = 1.0f;
        cells.bone_mpa[index(cells.dims, x, y, z)] = bone_mpa;
      }
    }
  return cells;
}

SeatLoad load_at(double from_middle_mm, double radius_mm) {
  SeatLoad load;
  load.x_mm = (first_x + 0.5 * length) * cell_mm + from_middle_mm;
  load.y_mm = (first_y + 0.5 * width) * cell_mm;
  load.radius_mm = radius_mm;
  return load;
}

constexpr SolverLimits limits{1e-8, 500};

float motion(const SeatResponse& response, const SeatedCells& cells, int column) {
  return response.motion_mm[index(cells.dims, first_x + column, first_y + width / 2, 0)];
}

TEST(SeatedComponent, AnEvenLoadStrainsEachLayerAsItsModulusSays) {
  const SeatedCells cells = blocks(500.0f);
  SeatMaterials materials;
  materials.poisson = 0.0;
  const SeatedComponent seated(cells, materials);
  ThreadPool pool(2);
  const SeatResponse response = seated.respond(load_at(0.0, 100.0), limits, pool);
  ASSERT_TRUE(response.converged && response.settled);
  const double area_mm2 = length * width * cell_mm * cell_mm, stress_mpa = 750.0 / area_mm2;
  EXPECT_NEAR(response.held_n, 750.0, 1e-4);
  EXPECT_DOUBLE_EQ(response.carrying_share, 1.0);
  for (int z = component_to + 1; z < bone_to; ++z)
    EXPECT_NEAR(response.effective_strain[index(cells.dims, first_x + 1, first_y + 1, z)], stress_mpa / 500.0,
                1e-6)
        << z;
  EXPECT_NEAR(motion(response, cells, 3), stress_mpa / materials.cement_mpa * cell_mm, 1e-6);
  const double bone_mm = (bone_to - component_to - 1) * cell_mm;
  const double component_mm = (component_to - component_from) * cell_mm;
  EXPECT_NEAR(response.sinking_mm,
              stress_mpa *
                  (bone_mm / 500.0 + cell_mm / materials.cement_mpa + component_mm / materials.component_mpa),
              1e-5);
}

/// A stiff footing on springs that only push: where the load is nearer to its edge than a third of its
/// length, three times that distance carries, with a pressure that falls evenly to nothing.
TEST(SeatedComponent, LiftsOffAsAStiffFootingDoes) {
  const SeatedCells cells = blocks(1e7f);
  SeatMaterials materials;
  materials.poisson = 0.0;
  materials.component_mpa = 1e7;
  materials.cement_mpa = 10.0;
  const SeatedComponent seated(cells, materials);
  ThreadPool pool(2);
  const double length_mm = length * cell_mm, width_mm = width * cell_mm;
  for (const double off : {0.0, 0.1, 0.15, 0.2, 0.25, 0.3}) {
    const SeatResponse response = seated.respond(load_at(off * length_mm, 0.8), limits, pool);
    ASSERT_TRUE(response.converged && response.settled) << off;
    EXPECT_NEAR(response.held_n, 750.0, 1e-3) << off;
    const double carrying = off <= 1.0 / 6.0 ? 1.0 : 3.0 * (0.5 - off);
    EXPECT_NEAR(response.carrying_share, carrying, 0.5 / length + 1e-9) << off;
    const double spring_n_mm3 = materials.cement_mpa / cell_mm;
    const double mean_mm = 750.0 / (length_mm * width_mm * spring_n_mm3);
    const double greatest = off <= 1.0 / 6.0 ? mean_mm * (1.0 + 6.0 * off) : 2.0 * mean_mm / carrying;
    const double least = off <= 1.0 / 6.0 ? mean_mm * (1.0 - 6.0 * off) : 0.0;
    const double pressed_at = (0.5 / length) / carrying;
    EXPECT_NEAR(motion(response, cells, length - 1), greatest + (least - greatest) * pressed_at,
                0.02 * greatest)
        << off;
  }
}

TEST(SeatedComponent, WhatIsNotSupportedIsNotCarried) {
  SeatedCells cells = blocks(1000.0f);
  for (int y = 0; y < cells.dims.y(); ++y)
    for (int x = 0; x < first_x + length / 2; ++x) cells.supported[index(cells.dims, x, y, 0)] = 0;
  ThreadPool pool(2);
  const SeatedComponent seated(cells, {});
  const SeatResponse response = seated.respond(load_at(0.25 * length * cell_mm, 1.0), limits, pool);
  ASSERT_TRUE(response.converged && response.settled);
  EXPECT_LE(response.carrying_share, 0.5);
  EXPECT_NEAR(response.held_n, 750.0, 1e-4);
  EXPECT_TRUE(std::isnan(motion(response, cells, 1)));
  EXPECT_FALSE(std::isnan(motion(response, cells, length - 1)));
}

TEST(SeatedComponent, TheMirrorImageAnswersAsItsMirrorImage) {
  SeatedCells cells = blocks(300.0f);
  for (size_t i = 0; i < cells.bone_mpa.size(); ++i)
    cells.bone_mpa[i] *= 1.0f + 0.1f * static_cast<float>(i * 7919 % 13);
  SeatedCells mirrored = cells;
  for (int z = 0; z < cells.dims.z(); ++z)
    for (int y = 0; y < cells.dims.y(); ++y)
      for (int x = 0; x < cells.dims.x(); ++x)
        mirrored.bone_mpa[index(cells.dims, x, y, z)] =
            cells.bone_mpa[index(cells.dims, cells.dims.x() - 1 - x, y, z)];
  ThreadPool pool(2);
  const SeatResponse one = SeatedComponent(cells, {}).respond(load_at(2.2, 1.4), limits, pool);
  const SeatResponse other = SeatedComponent(mirrored, {}).respond(load_at(-2.2, 1.4), limits, pool);
  ASSERT_TRUE(one.settled && other.settled);
  EXPECT_DOUBLE_EQ(one.carrying_share, other.carrying_share);
  EXPECT_NEAR(one.sinking_mm, other.sinking_mm, 1e-6 * one.sinking_mm);
  for (int column = 0; column < length; ++column)
    EXPECT_NEAR(motion(one, cells, column), motion(other, cells, length - 1 - column),
                1e-4 * motion(one, cells, length - 1));
}

/// A component in steps, as a domed back is: the joint lies behind it alone.
TEST(SeatedComponent, TheJointOfASteppedComponentLiesBehindIt) {
  SeatedCells cells = blocks(1000.0f);
  size_t behind = 0, in_bone = 0;
  for (int y = first_y; y < first_y + width; ++y)
    for (int x = first_x; x < first_x + length; ++x) {
      const int step = std::abs(2 * (x - first_x) + 1 - length) / 6;  // the rim is further forward
      for (int z = 0; z < bone_to; ++z) {
        const int from = component_from + 3 - step;
        cells.component[index(cells.dims, x, y, z)] = z >= from && z < from + 2 ? 1 : 0;
        cells.bone_share[index(cells.dims, x, y, z)] = z >= from + 2 ? 1.0f : 0.0f;
        cells.bone_mpa[index(cells.dims, x, y, z)] = 1000.0f;
        in_bone += z >= from + 2;
        behind += z >= from && z < from + 2;
      }
    }
  // All bone under the component counts once, as bone or as joint; in front of it is nothing.
  EXPECT_EQ(SeatedComponent(cells, {}).elements(), behind + in_bone);
}

TEST(SeatedComponent, SaysWhatCannotBe) {
  ThreadPool pool(1);
  SeatedCells floating = blocks(1000.0f);
  for (int y = 0; y < floating.dims.y(); ++y)
    for (int x = 0; x < floating.dims.x(); ++x)
      floating.bone_share[index(floating.dims, x, y, bone_to - 3)] = 0.0f;
  EXPECT_THROW(SeatedComponent(floating, {}), Error);
  const SeatedComponent seated(blocks(1000.0f), {});
  EXPECT_THROW(seated.respond(load_at(100.0, 2.0), limits, pool), Error);
  EXPECT_THROW(SeatedComponent(blocks(1e15f), {}), Error);
  SeatMaterials locked;
  locked.poisson = 0.5;
  EXPECT_THROW(SeatedComponent(blocks(1000.0f), locked), Error);
}

TEST(SeatedComponent, LooseBoneIsLeftOut) {
  SeatedCells cells = blocks(1000.0f);
  const size_t without = SeatedComponent(cells, {}).elements();
  const size_t loose = index(cells.dims, 1, 1, 7);
  cells.bone_share[loose] = 1.0f;
  cells.bone_mpa[loose] = 1000.0f;
  EXPECT_EQ(SeatedComponent(cells, {}).elements(), without);
}

}  // namespace
}  // namespace ream::solve
