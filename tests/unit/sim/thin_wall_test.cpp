#include <gtest/gtest.h>

#include <iostream>

#include "sim/approach.hpp"
#include "support/random_pose.hpp"
#include "support/seed.hpp"
#include "support/small_run.hpp"
#include "support/watched_backend.hpp"

namespace ream::test {
namespace {

constexpr double voxel_mm = 0.2;
constexpr double size_mm = 120 * voxel_mm;
/// Half the wall, one look for contact, and the edge of a guiding end face, whose points meet bone up to two
/// voxels inside it.
constexpr double deepest_allowed_mm = 4.0 * voxel_mm;

/// A plane in the grid frame: normal and its signed distance from the origin.
struct Plane {
  Vec3 normal;
  double offset_mm;
  double distance_mm(const Vec3& p) const { return normal.dot(p) - offset_mm; }
};

/// A wall of one voxel in air: the thinnest set of voxels that no path through faces crosses (6-separating).
voxel::BoneModel wall(const Plane& plane) {
  voxel::VoxelGrid grid;
  grid.dims = Vec3i::Constant(120);
  grid.spacing_mm = Vec3::Constant(voxel_mm);
  voxel::BoneModel bone = voxel::make_bone(grid);
  const double half_mm = 0.5 * voxel_mm * plane.normal.cwiseAbs().maxCoeff();
  std::fill(bone.density.writable().begin(), bone.density.writable().end(), uint8_t{150});
  for (uint32_t b = 0; b < grid.brick_count(); ++b) {
    const Vec3i first = grid.brick_coordinates(b) * voxel::brick_edge;
    if (std::abs(plane.distance_mm(grid.centre_mm(first))) > 2.0 * voxel::brick_edge * voxel_mm) continue;
    for (size_t i = grid.brick_base(b); i < grid.brick_base(b) + voxel::brick_voxels; ++i) {
      const double d = plane.distance_mm(grid.centre_mm(grid.coordinates(i)));
      if (d >= -half_mm && d < half_mm) bone.coverage[i] = 255;
    }
  }
  return bone;
}

struct WallRun {
  WallRun(const Plane& plane_, const std::string& tool)
      : plane(plane_), run(wall(plane_), case_plan(), tool, steady_push(0.0, 1.0)) {}
  static case_::Plan case_plan() {
    case_::Plan plan;
    plan.entry_mm = Vec3::Constant(0.5 * size_mm);
    plan.axis_direction = Vec3::UnitZ();
    plan.pilot_hole.reset();
    return plan;
  }

  record::TickReport tick(const Pose& world_from_handle, bool spindle_on = false) {
    device::DeviceInput input;
    input.world_from_handle = world_from_handle;
    input.spindle_on = spindle_on;
    record::TickReport report;
    EXPECT_EQ(sim::step(run.model, run.state, input, report), sim::StepStatus::ok);
    return report;
  }

  /// How far the tool has got past the middle of the wall, counting only what is inside the grid.
  double deepest_mm(const Pose& grid_from_tool) const {
    const Aabb inside = run.bone.grid.bounds_mm().grown(-2.0 * voxel_mm);
    double deepest = -1e9;
    for (const Vec3f& v : run.model.tool.mesh.vertices_mm) {
      const Vec3 p = grid_from_tool.point(v.cast<double>());
      if (inside.contains(p)) deepest = std::max(deepest, plane.distance_mm(p));
    }
    return deepest;
  }

  Plane plane;
  SmallRun run;
};

struct Motion {
  double speed_mm_s, turn_rad_s;
};

/// A place before the wall: the whole tool is at least 2 mm on the near side, however it is turned.
Pose start_pose(const WallRun& w, std::mt19937& random, const Vec3& direction) {
  const Vec3 middle = Vec3::Constant(0.5 * size_mm) + random_vector(random, 1.5);
  const Vec3 on_plane = middle - w.plane.distance_mm(middle) * w.plane.normal;
  double reach_mm = 0.0;
  for (const Vec3f& v : w.run.model.tool.mesh.vertices_mm)
    reach_mm = std::max(reach_mm, static_cast<double>(v.norm()));
  return {random_pose(random).rotation,
          on_plane - (reach_mm + 2.0) / direction.dot(w.plane.normal) * direction};
}

TEST(ThinWall, IsMetAtAnySpeedOfTheHandFromAnySide) {
  const uint32_t seed = test::seed(20260301);
  std::cout << "seed " << seed << '\n';
  std::mt19937 random(seed);
  const char* tools[] = {"sphere 4,3", "ellipse 3,2 nipple 1,2", "sphere 3,3 back 1.25"};
  const Motion motions[] = {{1000.0, 0.0}, {1000.0, 10.0}, {150.0, 10.0}, {5000.0, 60.0}};
  int met = 0;
  for (int i = 0; i < 60; ++i) {
    const Motion motion = motions[i % 4];
    const Plane plane{random_direction(random), 0.0};
    Plane placed = plane;
    placed.offset_mm = plane.normal.dot(Vec3::Constant(0.5 * size_mm) + random_vector(random, 1.0));
    WallRun w(placed, tools[i % 3]);
    Vec3 direction = (plane.normal + 0.8 * random_vector(random, 1.0)).normalized();
    if (direction.dot(plane.normal) < 0.4) direction = plane.normal;
    const Pose start = start_pose(w, random, direction);
    const Vec3 turning = random_direction(random);
    bool engaged = false;
    const int ticks = static_cast<int>(50.0 / motion.speed_mm_s * 1000.0) + 20;
    for (int t = 0; t < ticks; ++t) {
      const Pose handle{rotation_about(turning, 1e-3 * t * motion.turn_rad_s) * start.rotation,
                        start.translation_mm + 1e-3 * t * motion.speed_mm_s * direction};
      const record::TickReport report = w.tick(handle);
      engaged |= report.engaged;
      ASSERT_LT(w.deepest_mm(dequantised(report.grid_from_tool)), deepest_allowed_mm)
          << "seed " << seed << " case " << i << " tick " << t << (engaged ? " engaged" : " not engaged");
    }
    met += engaged;
    EXPECT_TRUE(engaged) << "seed " << seed << " case " << i;
  }
  std::cout << met << " of 60 walls met\n";
}

TEST(ThinWall, ATurningReamerMeetsItBeforeItCuts) {
  const uint32_t seed = test::seed(20260304);
  std::cout << "seed " << seed << '\n';
  std::mt19937 random(seed);
  for (int i = 0; i < 15; ++i) {
    Plane plane{random_direction(random), 0.0};
    plane.offset_mm = plane.normal.dot(Vec3::Constant(0.5 * size_mm));
    WallRun w(plane, "sphere 4,3");
    // The cutting cap first, tilted by up to half a radian.
    Pose start = start_pose(w, random, plane.normal);
    start.rotation = rotation_about(random_direction(random), random_vector(random, 0.5).x()) *
                     rotation_with_z_along(plane.normal);
    record::TickReport report;
    for (int t = 0; t < 40 && !report.engaged; ++t) {
      report = w.tick({start.rotation, start.translation_mm + 1.0 * t * plane.normal}, true);
      ASSERT_LT(w.deepest_mm(dequantised(report.grid_from_tool)), deepest_allowed_mm)
          << "seed " << seed << " case " << i << " tick " << t;
    }
    EXPECT_TRUE(report.engaged) << "seed " << seed << " case " << i;
  }
}

TEST(ThinWall, WithdrawingAndPlungingMeetsItEveryTime) {
  const uint32_t seed = test::seed(20260302);
  std::cout << "seed " << seed << '\n';
  std::mt19937 random(seed);
  for (int i = 0; i < 12; ++i) {
    Plane plane{random_direction(random), 0.0};
    plane.offset_mm = plane.normal.dot(Vec3::Constant(0.5 * size_mm));
    WallRun w(plane, "ellipse 3,2 nipple 1,2");
    const Pose start = start_pose(w, random, plane.normal);
    const Vec3 turning = random_direction(random);
    int contacts = 0;
    bool was = false;
    for (int t = 0; t < 400; ++t) {
      // 20 mm there and back, at up to 1 m/s, with a tilt of up to 10 rad/s.
      const double swing = 0.5 - 0.5 * std::cos(t * 0.1), tilt = 0.1 * std::sin(t * 0.1);
      const record::TickReport report = w.tick({rotation_about(turning, tilt) * start.rotation,
                                                start.translation_mm + 20.0 * swing * plane.normal});
      contacts += report.engaged && !was;
      was = report.engaged;
      ASSERT_LT(w.deepest_mm(dequantised(report.grid_from_tool)), deepest_allowed_mm)
          << "seed " << seed << " case " << i << " tick " << t;
    }
    EXPECT_GE(contacts, 6) << "seed " << seed << " case " << i;
  }
}

TEST(Approach, LooksOnlyWhereTheDistanceFieldLeavesDoubt) {
  WallRun w({Vec3::UnitZ(), 2.0}, "sphere 4,3");
  int looks = 0;
  w.run.state.backend.narrow_phase =
      std::make_unique<CountingNarrowPhase>(std::move(w.run.state.backend.narrow_phase), looks);
  const auto at = [](double z) { return Pose{rotation_with_z_along(-Vec3::UnitZ()), Vec3(12.0, 12.0, z)}; };
  w.tick(at(60.0));
  EXPECT_EQ(looks, 1) << "the first place is looked at";
  for (int t = 0; t < 50; ++t) w.tick(at(60.0 - t));
  EXPECT_EQ(looks, 1) << "1 m/s through free space";
  for (int t = 0; t < 50; ++t) w.tick(at(11.0));
  EXPECT_EQ(looks, 1) << "at rest";
  for (int t = 0; t < 12; ++t) w.tick(at(11.0 - t));
  EXPECT_GT(looks, 5);
  EXPECT_LT(looks, 5 * 12) << "near the wall about five looks a millimetre, and none once it is met";
}

TEST(Approach, ThePathBoundHoldsForEveryPointOnTheWay) {
  const uint32_t seed = test::seed(20260303);
  std::mt19937 random(seed);
  WallRun w({Vec3::UnitZ(), 2.0}, "ellipse 3,2 nipple 1,2");
  for (int i = 0; i < 200; ++i) {
    const Pose a = random_pose(random, 5.0);
    const Pose b{a.rotation * rotation_about(random_direction(random), random_vector(random, 2.5).x()),
                 a.translation_mm + random_vector(random, 3.0)};
    const double bound_mm = sim::path_bound_mm(w.run.model, a, b);
    for (const Vec3f& v : w.run.model.tool.mesh.vertices_mm) {
      const Vec3 p = v.cast<double>();
      double path_mm = 0.0;
      Vec3 last = a.point(p);
      for (int k = 1; k <= 10; ++k) {
        const Pose on_the_way = sim::between(a, b, 0.1 * k);
        path_mm += (on_the_way.point(p) - last).norm();
        last = on_the_way.point(p);
        ASSERT_LE((last - a.point(p)).norm(), bound_mm * 0.1 * k + 1e-9) << "seed " << seed;
      }
      ASSERT_LE(path_mm, bound_mm + 1e-9) << "seed " << seed;
    }
  }
}

}  // namespace
}  // namespace ream::test
