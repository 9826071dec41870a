// A component on glenoids by formulas that carry out seeded plans.
#include "session/load/component_load.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "session/load/seat_cells.hpp"
#include "support/executed_plan.hpp"
#include "support/expect_error.hpp"

namespace ream::session {
namespace {

constexpr double voxel_mm = 0.4;

/// Quicker than what a user gets.
ComponentLoadRequest coarse() {
  ComponentLoadRequest request;
  request.cell_mm = 1.25;
  request.threads = 1;
  request.loads = 2;
  return request;
}

/// A component of 20 mm radius on a glenoid of 38 mm: bone stands under its middle alone, unless it is
/// reamed.
test::PlannedReaming planned_on(case_::Side side) {
  test::PlannedReaming planned = test::random_reaming(0, voxel_mm);
  planned.glenoid.shoulder.side = side;
  planned.glenoid.vault_mm = 32.0;
  planned.glenoid.radius_mm = 38.0;
  planned.glenoid.plate_mm = 4.0;
  const test::AnalyticGlenoid::Frame face = planned.glenoid.frame();
  planned.plan.axis_direction = planned.glenoid.mirrored(-face.n);
  planned.plan.entry_mm = planned.glenoid.mirrored(face.centre);
  planned.plan.depth_mm = 1.5;
  planned.plan.pilot_hole.reset();
  planned.reamer = {};
  planned.reamer.across_mm = planned.reamer.along_mm = 20.0;
  planned.reamer.outer_mm = 11.0;
  planned.plan.reamer = planned.reamer.words();
  planned.plan.implant_radius_mm = 20.0;
  return planned;
}

ComponentLoad load_of(const test::ExecutedPlan& plan, const test::Stray& stray,
                      const ComponentLoadRequest& request) {
  const test::ExecutedPlan::Left left = plan.left(stray);
  return load_component(plan.native(), plan.bone(),
                        seat_states(plan.native(), plan.bone().grid, plan.bone().coverage.data(),
                                    left.coverage.data(), left.line),
                        request);
}

const test::ExecutedPlan& right_plan() {
  static const test::ExecutedPlan plan(planned_on(case_::Side::right), voxel_mm);
  return plan;
}
const ComponentLoad& right_load() {
  static const ComponentLoad load = load_of(right_plan(), {}, coarse());
  return load;
}
/// Seated, and not loaded.
ComponentLoadRequest seated_only() {
  ComponentLoadRequest request = coarse();
  request.loads = 0;
  return request;
}

TEST(ComponentLoad, ReamingAsPlannedSupportsTheComponent) {
  const ComponentLoad& load = right_load();
  ASSERT_EQ(load.states.size(), 3u);
  const LoadedState &before = *load.state("before"), &planned = *load.state("planned"),
                    &reamed = *load.state("reamed");
  EXPECT_TRUE(load.settled());
  EXPECT_LT(before.supported_percent, 75.0);
  EXPECT_GT(planned.supported_percent, 95.0);
  EXPECT_GT(before.motion_um(), 2.0 * planned.motion_um());
  EXPECT_GT(before.support_lost_percent, planned.support_lost_percent);
  // The session did what the plan says.
  EXPECT_NEAR(reamed.supported_percent, planned.supported_percent, 5.0);
  EXPECT_NEAR(reamed.motion_um(), planned.motion_um(), 0.25 * planned.motion_um());
  ASSERT_TRUE(reamed.plate_strain() && planned.plate_strain());
  EXPECT_NEAR(*reamed.plate_strain(), *planned.plate_strain(), 0.25 * *planned.plate_strain());
  for (const LoadedState& state : load.states)
    for (const LoadedSeat& seat : state.loads) {
      EXPECT_GT(seat.sinking_um, 0.0) << state.name << " " << seat.name;
      EXPECT_LE(seat.carrying_percent, state.supported_percent + 0.1) << state.name << " " << seat.name;
    }
}

/// Contact that only pushes, without a gap: twice the load moves all twice as far, and opens nothing new.
TEST(ComponentLoad, TwiceTheLoadDoesTwiceAsMuch) {
  const ComponentLoad& one = right_load();
  ComponentLoadRequest request = coarse();
  request.force_n *= 2.0;
  const ComponentLoad two = load_of(right_plan(), {}, request);
  for (size_t s = 0; s < one.states.size(); ++s)
    for (size_t l = 0; l < one.states[s].loads.size(); ++l) {
      const LoadedSeat &a = one.states[s].loads[l], &b = two.states[s].loads[l];
      EXPECT_DOUBLE_EQ(a.carrying_percent, b.carrying_percent);
      EXPECT_NEAR(2.0 * a.sinking_um, b.sinking_um, 1e-6 * b.sinking_um);
      EXPECT_NEAR(2.0 * a.motion_um, b.motion_um, 1e-5 * b.motion_um);
      EXPECT_NEAR(2.0 * *a.bone_strain, *b.bone_strain, 1e-5 * *b.bone_strain);
    }
}

TEST(ComponentLoad, ALeftShoulderIsTheMirrorImageOfARightOne) {
  const ComponentLoad& right = right_load();
  const ComponentLoad left = load_of({planned_on(case_::Side::left), voxel_mm}, {}, coarse());
  ASSERT_EQ(right.states.size(), left.states.size());
  for (size_t s = 0; s < right.states.size(); ++s) {
    const LoadedState &a = right.states[s], &b = left.states[s];
    EXPECT_NEAR(a.supported_percent, b.supported_percent, 0.5);
    for (size_t l = 0; l < a.loads.size(); ++l) {
      EXPECT_EQ(a.loads[l].name, b.loads[l].name);
      EXPECT_NEAR(a.loads[l].sinking_um, b.loads[l].sinking_um, 0.02 * a.loads[l].sinking_um)
          << a.name << " " << a.loads[l].name;
    }
  }
}

TEST(ComponentLoad, TooLittleReamedSupportsLess) {
  const ComponentLoad load = load_of(right_plan(), {.depth_mm = -1.0}, seated_only());
  EXPECT_LT(load.state("reamed")->supported_percent, load.state("planned")->supported_percent - 10.0);
}

/// The voxels of a bone of which x is less than `end`.
voxel::BoneModel first_part(const voxel::BoneModel& bone, int end) {
  voxel::VoxelGrid grid = bone.grid;
  grid.dims.x() = end;
  voxel::BoneModel part = voxel::make_bone(grid);
  std::vector<uint8_t>& density = part.density.writable();
  for (int z = 0; z < grid.dims.z(); ++z)
    for (int y = 0; y < grid.dims.y(); ++y)
      for (int x = 0; x < end; ++x) {
        const size_t from = bone.grid.index(x, y, z), to = grid.index(x, y, z);
        part.coverage[to] = bone.coverage[from];
        density[to] = bone.density[from];
      }
  return part;
}

/// Where what is known of the bone ends, it goes on: it is held there, and the strain under the component
/// stays.
TEST(ComponentLoad, BoneIsHeldWhereTheCaseEnds) {
  const test::ExecutedPlan& plan = right_plan();
  const voxel::VoxelGrid& grid = plan.bone().grid;
  const Pose grid_from_world = grid.world_from_grid.inverse();
  const Vec3 medial = plan.native().task().plan->axis_direction;
  const Vec3 at = grid_from_world.point(plan.native().task().plan->entry_mm + 20.0 * medial);
  ASSERT_GT(grid_from_world.direction(medial).x(), 0.8) << "the test cuts the bone off across x";
  const voxel::BoneModel part = first_part(plan.bone(), static_cast<int>(at.x() / voxel_mm) / 8 * 8);
  const auto before = [&](const voxel::BoneModel& bone) {
    const uint8_t* whole = bone.coverage.data();
    return load_component(plan.native(), bone,
                          seat_states(plan.native(), bone.grid, whole, whole, std::nullopt), coarse());
  };
  const ComponentLoad all = before(plan.bone()), less = before(part);
  for (size_t s = 0; s < all.states.size(); ++s)
    for (size_t l = 0; l < all.states[s].loads.size(); ++l) {
      const LoadedSeat &a = all.states[s].loads[l], &b = less.states[s].loads[l];
      // Held nearer, bone is stiffer.
      EXPECT_LE(b.sinking_um, 1.01 * a.sinking_um) << a.name;
      EXPECT_GE(b.sinking_um, 0.75 * a.sinking_um) << a.name;
      EXPECT_NEAR(*a.bone_strain, *b.bone_strain, 0.1 * *a.bone_strain) << a.name;
    }
}

/// It carries in no state, so that a session that does as planned is worth as much as the plan.
TEST(ComponentLoad, ThePilotHoleCountsAlikeInAllStates) {
  test::PlannedReaming planned = planned_on(case_::Side::right);
  planned.plan.pilot_hole = case_::PilotHole{6.4, 12.0};
  const ComponentLoad load = load_of({planned, voxel_mm}, {}, seated_only());
  EXPECT_NEAR(load.state("reamed")->supported_percent, load.state("planned")->supported_percent, 3.0);
  EXPECT_GT(load.state("planned")->supported_percent, 95.0);
}

TEST(ComponentLoad, NothingReamedLeavesTheOtherStates) {
  const test::ExecutedPlan& plan = right_plan();
  const uint8_t* whole = plan.bone().coverage.data();
  const ComponentLoad load =
      load_component(plan.native(), plan.bone(),
                     seat_states(plan.native(), plan.bone().grid, whole, whole, std::nullopt), seated_only());
  EXPECT_EQ(load.states.size(), 2u);
  EXPECT_EQ(load.state("reamed"), nullptr);
  test::expect_error(ErrorKind::conflict, "no component can be seated",
                     [&] { load_component(plan.native(), plan.bone(), {}, coarse()); });
}

}  // namespace
}  // namespace ream::session
