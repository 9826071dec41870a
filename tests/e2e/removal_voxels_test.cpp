#include <gtest/gtest.h>

#include <iostream>

#include "ct/phantom/phantom_case.hpp"
#include "support/small_run.hpp"
#include "support/swept_voxels.hpp"

namespace ream::test {
namespace {

constexpr double rim_backing_mm = 0.5;    // server/shell/swept_profile.hpp promises this much behind the rim
constexpr double table_error_mm = 0.012;  // of the product's distance table and of the reference's, together

case_::Case phantom(case_::Side side) {
  ct::PhantomParams params;
  params.side = side;
  params.spacing_mm = Vec3::Constant(0.5);
  params.field_mm = {{-8.0, -14.0, -18.0}, {12.0, 14.0, 18.0}};
  return ct::make_phantom_case("small", params, 2);
}

struct Plunge {
  const char* name;
  case_::Side side;
  const char* tool;
  std::vector<MeridianPoint> meridian;
  Vec3 start_mm, tilt_rad;
  const char* backend = "cpu";
};

void PrintTo(const Plunge& plunge, std::ostream* out) { *out << plunge.name; }

device::Script script_of(const Plunge& plunge) {
  device::Script script;
  script.duration_s = 5.0;
  script.stiffness_n_mm = 100.0;
  script.hand.start_mm = plunge.start_mm;
  script.hand.tilt_rad = plunge.tilt_rad;
  script.hand.force_profile = {{0.0, 5.0}, {1.0, 300.0}, {4.0, 300.0}, {4.5, -10.0}};
  return script;
}

SweptTally run(const Plunge& plunge) {
  case_::Case c = phantom(plunge.side);
  c.plan->pilot_hole.reset();
  SmallRun run(std::move(c.bone), *c.plan, plunge.tool, script_of(plunge), plunge.backend);
  const std::vector<uint8_t> before = run.bone.coverage;
  const voxel::SharedBytes density = run.bone.density;
  const auto reports = run.run();
  EXPECT_EQ(reports.size(), 5000u);
  EXPECT_EQ(run.bone.density, density) << "density never changes";
  const SweptTally tally = compare_with_sweep(run.bone, before, CuttingBody(plunge.meridian, rim_backing_mm),
                                              reports, table_error_mm);
  EXPECT_EQ(tally.levels_removed, reported_levels(reports));
  std::cout << plunge.name << ", " << plunge.backend << ": " << tally.text() << '\n';
  return tally;
}

class RemovalVoxels : public ::testing::TestWithParam<Plunge> {};

TEST_P(RemovalVoxels, BoneIsGoneWhereTheBodySweptAndNowhereElse) {
  const SweptTally tally = run(GetParam());
  EXPECT_EQ(tally.not_gone, 0u);
  EXPECT_EQ(tally.not_kept, 0u);
  EXPECT_EQ(tally.off_at_surface, 0u);
  EXPECT_EQ(tally.grown, 0u);
  EXPECT_GT(tally.removed_mm3, 8.0) << "nothing much was removed, so nothing was tested";
  EXPECT_GT(tally.must_be_kept, 100000u);
}

using case_::Side;
INSTANTIATE_TEST_SUITE_P(
    Plunges, RemovalVoxels,
    ::testing::Values(
        Plunge{"straight_right", Side::right, "sphere 12,9", sphere_meridian(12, 9), {0, 0, -3}, {0, 0, 0}},
        Plunge{"straight_left", Side::left, "sphere 12,9", sphere_meridian(12, 9), {0, 0, -3}, {0, 0, 0}},
        Plunge{
            "tilted_right", Side::right, "sphere 14,10", sphere_meridian(14, 10), {0, 0, -4}, {0.2, -0.1, 0}},
        Plunge{
            "tilted_left", Side::left, "ellipse 9,5", ellipse_meridian(9, 5), {0, 0, -4}, {-0.15, 0.12, 0}},
        Plunge{
            "off_centre_right", Side::right, "ellipse 9,5", ellipse_meridian(9, 5), {4, -3, -4}, {0, 0, 0}},
        Plunge{"off_centre_left", Side::left, "sphere 12,9", sphere_meridian(12, 9), {-3, 5, -4}, {0, 0, 0}},
        Plunge{"tilted_off_centre_opencl",
               Side::right,
               "sphere 12,9",
               sphere_meridian(12, 9),
               {3, 3, -4},
               {0.1, 0.1, 0},
               "opencl"}),
    [](const auto& name_of) { return std::string(name_of.param.name); });

TEST(RemovalVoxels, TheComparisonNoticesASingleWrongVoxel) {
  const Plunge plunge{"", Side::right, "sphere 12,9", sphere_meridian(12, 9), {0, 0, -3}, {0, 0, 0}};
  case_::Case c = phantom(plunge.side);
  c.plan->pilot_hole.reset();
  SmallRun run(std::move(c.bone), *c.plan, plunge.tool, script_of(plunge));
  const std::vector<uint8_t> before = run.bone.coverage;
  const auto reports = run.run();
  const CuttingBody body(plunge.meridian, rim_backing_mm);
  const Vec3 apex =
      run.bone.grid.world_from_grid.inverse().point(reports[4000].world_from_tool.translation_mm);
  const Vec3 axis = c.plan->axis_direction;
  uint8_t& below = run.bone.coverage[run.bone.grid.index(run.bone.grid.voxel_at(apex + 2.0 * axis))];
  below = static_cast<uint8_t>(below - 1);
  EXPECT_EQ(compare_with_sweep(run.bone, before, body, reports, table_error_mm).not_kept, 1u);
  below = static_cast<uint8_t>(below + 1);
  const size_t gone = run.bone.grid.index(run.bone.grid.voxel_at(apex - 0.4 * axis));
  ASSERT_NE(before[gone], 0);
  ASSERT_EQ(run.bone.coverage[gone], 0);
  run.bone.coverage[gone] = 1;
  EXPECT_EQ(compare_with_sweep(run.bone, before, body, reports, table_error_mm).wrong(), 1u);
}

}  // namespace
}  // namespace ream::test
