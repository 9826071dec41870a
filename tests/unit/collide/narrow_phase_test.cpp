#include "collide/narrow_phase.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "shell/tool.hpp"
#include "support/random_pose.hpp"
#include "support/test_bone.hpp"

namespace ream::test {
namespace {

struct Scene {
  explicit Scene(const std::string& tool_text)
      : bone(slab({64, 64, 64}, 0.25, 8.0, 1.4)),
        tool(shell::make_tool(tool_text)),
        shell(collide::make_contact_shell(shell::make_point_shell(tool, 0.3), 0.25)),
        distance(voxel::brick_distance(bone)),
        occupancy(voxel::occupancy(bone)),
        bounds(collide::bone_bounds_mm(bone)) {}

  collide::ContactSums contact(collide::NarrowPhase& phase, const QuantisedPose& pose) {
    const collide::Voi voi = collide::broad_phase(bounds, shell.bounds_mm, dequantised(pose), 0.25);
    collide::ContactSums sums;
    EXPECT_TRUE(phase.contact(pose, voi, sums));
    return sums;
  }

  voxel::BoneModel bone;
  shell::Tool tool;
  collide::ContactShell shell;
  voxel::BrickDistance distance;
  voxel::Occupancy occupancy;
  Aabb bounds;
};

/// Independent reference: every point, no culling, doubles and 64-bit sums.
collide::ContactSums reference(const Scene& s, const QuantisedPose& pose) {
  collide::ContactSums sums;
  const Pose grid_from_tool = dequantised(pose);
  const auto classes = voxel::class_table(s.bone.cortical_threshold_g_cc);
  for (size_t i = 0; i < s.shell.size(); ++i) {
    const Vec3 probe(s.shell.probe_x_mm[i], s.shell.probe_y_mm[i], s.shell.probe_z_mm[i]);
    const Vec3i at = s.bone.grid.voxel_at(grid_from_tool.point(probe));
    if (!s.bone.grid.contains(at) || s.bone.coverage[s.bone.grid.index(at)] < collide::engaging_coverage)
      continue;
    collide::ContactSums::Part& part = s.shell.guiding[i] ? sums.guiding : sums.cutting;
    const auto& g = s.shell.vectors[i];
    const int64_t w = s.shell.weights[i];
    ++part.points;
    for (size_t k = 0; k < 7; ++k) part.first[k] += w * g[k];
    size_t slot = 0;
    for (size_t a = 0; a < 6; ++a)
      for (size_t b = a; b < 6; ++b) part.second[slot++] += w * g[a] * g[b];
    if (s.shell.guiding[i]) continue;
    const uint8_t code = s.bone.density[s.bone.grid.index(at)];
    ++sums.class_points[static_cast<size_t>(classes[code])];
    sums.class_density[static_cast<size_t>(classes[code])] += code;
  }
  return sums;
}

TEST(NarrowPhase, CulledFloatSumsMatchAFullDoubleSearch) {
  constexpr unsigned seed = 42;
  std::mt19937 random(seed);
  Scene s("ellipse 6,3 nipple 1,2");
  const auto phase = collide::make_narrow_phase_cpu({s.shell, s.bone, s.distance, s.occupancy});
  int64_t engaged = 0;
  for (int i = 0; i < 200; ++i) {
    Pose pose = random_pose(random, 0.0);
    pose.translation_mm = Vec3(8, 8, 8) + random_vector(random, 7.0);
    const QuantisedPose q = quantised(pose);
    const collide::ContactSums got = s.contact(*phase, q), expected = reference(s, q);
    // A probe within rounding of a voxel border may fall either way: none, or a handful of points.
    EXPECT_NEAR(static_cast<double>(got.engaged()), static_cast<double>(expected.engaged()), 3.0)
        << "seed " << seed << " case " << i;
    if (got.engaged() == expected.engaged()) {
      EXPECT_EQ(got, expected) << "seed " << seed << " case " << i;
    }
    engaged += got.engaged();
  }
  EXPECT_GT(engaged, 100000);
}

TEST(NarrowPhase, SumsOfAFlatContactAreThoseOfTheGeometry) {
  Scene s("sphere 6,4");
  const auto phase = collide::make_narrow_phase_cpu({s.shell, s.bone, s.distance, s.occupancy});
  Pose grid_from_tool{rotation_with_z_along(-Vec3::UnitZ()), Vec3(8.0, 8.0, 7.0)};
  const collide::ContactSums sums = s.contact(*phase, quantised(grid_from_tool));
  // The apex is 1 mm below the surface: the engaged cap of the probes has area 2 pi R h.
  const double area_mm2 = static_cast<double>(sums.cutting.first[6]) / 16.0 * s.shell.cell_area_mm2;
  const double probe_depth_mm = 1.0 + s.shell.probe_length_mm;
  const double cap_mm2 = 2.0 * 3.14159265 * 6.0 * probe_depth_mm * 6.0 / (6.0 + s.shell.probe_length_mm);
  EXPECT_NEAR(area_mm2, cap_mm2, 0.06 * cap_mm2);
  EXPECT_EQ(sums.guiding.points, 0);
  EXPECT_EQ(sums.class_points[static_cast<size_t>(voxel::BoneClass::cortical)], sums.cutting.points);
  EXPECT_EQ(sums.class_density[static_cast<size_t>(voxel::BoneClass::cortical)], 140 * sums.cutting.points);
  // Symmetry about the axis: no sideways force, no moment about the apex along z.
  const auto force_z = static_cast<double>(sums.cutting.first[2]);
  EXPECT_GT(force_z, 0.0);
  EXPECT_LT(std::abs(static_cast<double>(sums.cutting.first[0])), 0.02 * force_z);
  EXPECT_LT(std::abs(static_cast<double>(sums.cutting.first[1])), 0.02 * force_z);
}

TEST(NarrowPhase, FarAwayNothingTouches) {
  Scene s("sphere 6,4");
  const auto phase = collide::make_narrow_phase_cpu({s.shell, s.bone, s.distance, s.occupancy});
  EXPECT_EQ(s.contact(*phase, quantised({Mat3::Identity(), Vec3(8, 8, 500)})).engaged(), 0);
}

}  // namespace
}  // namespace ream::test
