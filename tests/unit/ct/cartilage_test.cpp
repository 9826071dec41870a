#include "ct/build/cartilage.hpp"

#include <gtest/gtest.h>

#include "ct/phantom/phantom_case.hpp"
#include "support/expect_error.hpp"
#include "voxel/bone_model.hpp"

namespace ream::ct {
namespace {

const case_::Case& bare(case_::Side side) {
  static const auto make = [](case_::Side of) {
    PhantomPreset preset = phantom_preset("demo");
    preset.params.side = of;
    preset.params.field_mm = {{-10.0, -20.0, -28.0}, {24.0, 26.0, 28.0}};
    return make_phantom_case("bare", preset.params, 2);
  };
  static const case_::Case right = make(case_::Side::right), left = make(case_::Side::left);
  return side == case_::Side::right ? right : left;
}

case_::Case covered(case_::Side side, const CartilageSettings& settings) {
  case_::Case c = bare(side);
  add_cartilage(c.bone, *c.glenoid, settings);
  return c;
}

/// A point of the face: off the centre along superior and anterior, lateral of the centre's plane.
Vec3 off_centre(const case_::GlenoidFrame& g, double superior_mm, double anterior_mm) {
  return g.centre_mm + superior_mm * g.superior + anterior_mm * g.anterior;
}

TEST(Cartilage, IsAsThickAsAskedAlongTheNormalOfTheFace) {
  for (const case_::Side side : {case_::Side::right, case_::Side::left})
    for (const double thickness_mm : {1.0, 2.0, 3.0}) {
      CartilageSettings settings;
      settings.thickness_mm = thickness_mm;
      const case_::Case with = covered(side, settings);
      const case_::GlenoidFrame& g = *with.glenoid;
      const Vec3 sphere_centre = g.centre_mm + PhantomParams{}.glenoid_radius_mm * g.lateral;
      double sum = 0.0, count = 0.0;
      for (double s = -12.0; s <= 10.0; s += 2.0)
        for (double a = -7.0; a <= 7.0; a += 2.0) {
          const Vec3 at = off_centre(g, s, a), normal = (sphere_centre - at).normalized();
          const auto bone = case_::surface_along(bare(side).bone, at, -normal),
                     top = case_::surface_along(with.bone, at, -normal);
          ASSERT_TRUE(bone && top);
          EXPECT_NEAR((*top - *bone).dot(normal), thickness_mm, 0.25) << s << ' ' << a;
          sum += (*top - *bone).dot(normal), ++count;
        }
      EXPECT_NEAR(sum / count, thickness_mm, 0.1);
    }
}

TEST(Cartilage, IsMetFirstAndLeavesTheBoneBeneathAsItWas) {
  const case_::Case& without = bare(case_::Side::right);
  const case_::Case with = covered(case_::Side::right, {});
  const auto& grid = with.bone.grid;
  const auto classes = voxel::class_table();
  size_t cartilage = 0;
  for (size_t i = 0; i < with.bone.coverage.size(); ++i) {
    if (without.bone.coverage[i] >= 128) {
      ASSERT_EQ(with.bone.density[i], without.bone.density[i]);
      ASSERT_GE(with.bone.coverage[i], without.bone.coverage[i]);
    } else if (with.bone.coverage[i] != without.bone.coverage[i]) {
      ASSERT_EQ(with.bone.density[i], voxel::cartilage_code);
      ++cartilage;
    } else {
      ASSERT_EQ(with.bone.density[i], without.bone.density[i]);
    }
  }
  EXPECT_GT(cartilage, 1000u);
  const case_::GlenoidFrame& g = *with.glenoid;
  for (double s = -10.0; s <= 8.0; s += 3.0)
    for (double a = -6.0; a <= 6.0; a += 3.0) {
      const auto top = case_::surface_along(with.bone, off_centre(g, s, a), -g.lateral);
      ASSERT_TRUE(top);
      const Vec3 within = grid.world_from_grid.inverse().point(*top - 0.3 * g.lateral);
      EXPECT_EQ(classes[with.bone.density[grid.index(grid.voxel_at(within))]], voxel::BoneClass::cartilage);
    }
}

TEST(Cartilage, NoGapLiesBetweenItAndTheBone) {
  const case_::Case with = covered(case_::Side::right, {});
  const case_::GlenoidFrame& g = *with.glenoid;
  const Pose grid_from_world = with.bone.grid.world_from_grid.inverse();
  for (double s = -10.0; s <= 8.0; s += 1.5)
    for (double a = -6.0; a <= 6.0; a += 1.5) {
      const auto top = case_::surface_along(with.bone, off_centre(g, s, a), -g.lateral);
      ASSERT_TRUE(top);
      for (double depth = 0.3; depth < 3.0; depth += 0.1)
        ASSERT_GT(voxel::coverage_at(with.bone, grid_from_world.point(*top - depth * g.lateral)), 190.0)
            << s << ' ' << a << ' ' << depth;
    }
}

TEST(Cartilage, StaysOnTheFace) {
  const case_::Case with = covered(case_::Side::right, {});
  const case_::GlenoidFrame& g = *with.glenoid;
  const auto& grid = with.bone.grid;
  for (size_t i = 0; i < with.bone.coverage.size(); ++i) {
    if (with.bone.density[i] != voxel::cartilage_code || with.bone.coverage[i] < 128) continue;
    const Vec3 offset = grid.world_from_grid.point(grid.centre_mm(grid.coordinates(i))) - g.centre_mm;
    // The sphere's face rises towards the rim; nothing lies behind the centre's plane.
    ASSERT_GT(offset.dot(g.lateral), -1.0);
    ASSERT_LT(std::abs(offset.dot(g.superior)), 24.0);
    ASSERT_LT(std::abs(offset.dot(g.anterior)), 18.0);
  }
}

TEST(Cartilage, ThicknessZeroChangesNothing) {
  CartilageSettings none;
  none.thickness_mm = 0.0;
  const case_::Case with = covered(case_::Side::right, none);
  EXPECT_EQ(with.bone.coverage, bare(case_::Side::right).bone.coverage);
  EXPECT_EQ(with.bone.density, bare(case_::Side::right).bone.density);
}

TEST(Cartilage, RefusesWhatCannotBe) {
  case_::Case c = bare(case_::Side::right);
  CartilageSettings settings;
  settings.thickness_mm = 7.0;
  test::expect_error(ErrorKind::invalid_input, "thickness",
                     [&] { add_cartilage(c.bone, *c.glenoid, settings); });
  case_::GlenoidFrame elsewhere = *c.glenoid;
  elsewhere.centre_mm += Vec3(500, 0, 0);
  test::expect_error(ErrorKind::invalid_input, "no articular face",
                     [&] { add_cartilage(c.bone, elsewhere, {}); });
}

}  // namespace
}  // namespace ream::ct
