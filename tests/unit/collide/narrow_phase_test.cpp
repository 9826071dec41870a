#include "collide/contact/narrow_phase.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "shell/tool.hpp"
#include "support/random_pose.hpp"
#include "support/seed.hpp"
#include "support/test_bone.hpp"

namespace ream::test {
namespace {

struct ContactScene {
  explicit ContactScene(const std::string& tool_text)
      : bone(slab({64, 64, 64}, 0.25, 8.0, 1.4)),
        tool(shell::make_tool(tool_text)),
        shell(collide::make_contact_shell(shell::make_point_shell(tool, 0.3), 0.25)),
        distance(voxel::brick_distance(bone)),
        cells(bone) {
    for (uint32_t code = 0; code < resistances.size(); ++code) resistances[code] = code * 7919 % 4096;
  }

  collide::ContactSums contact(collide::NarrowPhase& phase, const QuantisedPose& pose) {
    const collide::Voi voi =
        collide::broad_phase(cells.bounds_mm(), shell.bounds_mm, dequantised(pose), 0.25);
    collide::ContactSums sums;
    EXPECT_TRUE(phase.contact(pose, voi, sums));
    return sums;
  }

  collide::NarrowPhaseInput input() const { return {shell, bone, distance, cells, resistances}; }

  voxel::BoneModel bone;
  shell::Tool tool;
  collide::ContactShell shell;
  voxel::BrickDistance distance;
  voxel::SolidCells cells;
  collide::ResistanceTable resistances{};
};

void add(collide::ContactSums::Part& part, const collide::ContactVector& v) {
  const std::array<int64_t, 6> g{v.g[0], v.g[1], v.g[2], v.g[3], v.g[4], 0};
  ++part.points;
  for (size_t k = 0; k < 6; ++k) part.first[k] += v.weight * g[k];
  part.around[0] += v.weight * v.cosine;
  part.around[1] += v.weight * v.sine;
  part.first[6] += v.weight;
  part.area += v.area;
  size_t slot = 0;
  for (size_t a = 0; a < 6; ++a)
    for (size_t b = a; b < 6; ++b) part.second[slot++] += v.weight * g[a] * g[b];
}

/// The voxel that judges a cutting point, and what removal would leave of it, in doubles: the one of the
/// column through the point whose centre is nearest to the surface, if removal leaves part of it.
struct Judge {
  Vec3i at;
  double kept = 0.0;
};

Judge judge(const voxel::VoxelGrid& grid, const Vec3& point, const Vec3& normal) {
  const auto kept = [&](const Vec3i& at) {
    const Vec3 centre = (at.cast<double>().array() + 0.5) * grid.spacing_mm.array();
    return 127.5 + 255.0 * normal.dot(centre - point) / grid.min_spacing_mm();
  };
  Eigen::Index axis = 0;
  normal.cwiseProduct(grid.spacing_mm).cwiseAbs().maxCoeff(&axis);
  Judge best{grid.voxel_at(point)};
  best.kept = kept(best.at);
  for (const int step : {-1, 1}) {
    Vec3i at = grid.voxel_at(point);
    at[axis] += step;
    if (best.kept > 0.0 && best.kept < 255.0) break;
    if (std::abs(kept(at) - 127.5) < std::abs(best.kept - 127.5)) best = {at, kept(at)};
  }
  return best;
}

bool engages(const ContactScene& s, const Vec3& point, const Vec3& normal, Vec3i& at) {
  double needed = voxel::solid_coverage - 8.0;
  at = s.bone.grid.voxel_at(point);
  if (normal != Vec3::Zero()) {
    const Judge by = judge(s.bone.grid, point, normal);
    at = by.at;
    needed = std::max(1.0, std::min(by.kept, 255.0) - 8.0);
  }
  return s.bone.grid.contains(at) && s.bone.coverage[s.bone.grid.index(at)] >= needed;
}

Vec3 normal_of(const collide::ContactShell& shell, uint32_t point) {
  Vec3 normal;
  for (int k = 0; k < 3; ++k) normal[k] = static_cast<int8_t>(shell.normals[point] >> (8 * k));
  return normal == Vec3::Zero() ? normal : normal.normalized();
}

/// Independent reference: every point, no culling, no cells, positions in doubles.
collide::ContactSums reference(const ContactScene& s, const QuantisedPose& pose) {
  collide::ContactSums sums;
  const Pose grid_from_tool = dequantised(pose);
  const auto classes = voxel::class_table(s.bone.cortical_threshold_g_cc);
  double deepest_mm = -1e300;
  for (const collide::ContactBlock& block : s.shell.blocks)
    for (uint32_t i = block.first; i < block.first + block.count; ++i) {
      const Vec3 probe = s.shell.probe_mm(block, i);
      Vec3i at;
      if (!engages(s, grid_from_tool.point(probe), grid_from_tool.direction(normal_of(s.shell, i)), at))
        continue;
      add(block.guiding ? sums.guiding : sums.cutting, s.shell.table.vector(s.shell.direction(i)));
      if (block.guiding) continue;
      const uint8_t code = s.bone.density[s.bone.grid.index(at)];
      const auto weight = static_cast<int64_t>(s.shell.normals[i] >> 24);
      sums.class_weight[static_cast<size_t>(classes[code])] += weight;
      sums.class_density[static_cast<size_t>(classes[code])] += weight * code;
      sums.resistance += weight * s.resistances[code];
      if (probe.z() <= deepest_mm) continue;
      deepest_mm = probe.z();
      sums.deepest = collide::ContactSums::depth_key(
          static_cast<int32_t>(std::lround(probe.z() / s.shell.place_unit_mm)), i);
    }
  return sums;
}

TEST(NarrowPhase, CulledWholeNumberSumsMatchAFullSearchInDoubles) {
  const uint32_t seed = test::seed(42);
  std::mt19937 random(seed);
  ContactScene s("ellipse 6,3 nipple 1,2");
  const auto phase = collide::make_narrow_phase_cpu(s.input());
  int64_t engaged = 0;
  int equal = 0;
  for (int i = 0; i < 200; ++i) {
    Pose pose = random_pose(random, 0.0);
    pose.translation_mm = Vec3(8, 8, 8) + random_vector(random, 7.0);
    const QuantisedPose q = quantised(pose);
    const collide::ContactSums got = s.contact(*phase, q), expected = reference(s, q);
    // A point within rounding of the surface or of a voxel's border may fall either way: a handful of points.
    EXPECT_NEAR(static_cast<double>(got.engaged()), static_cast<double>(expected.engaged()),
                6.0 + 0.01 * static_cast<double>(expected.engaged()))
        << "seed " << seed << " case " << i;
    const bool same_points =
        got.cutting.points == expected.cutting.points && got.guiding.points == expected.guiding.points;
    if (same_points && got.cutting.first == expected.cutting.first &&
        got.guiding.first == expected.guiding.first && got.deepest == expected.deepest) {
      EXPECT_EQ(got, expected) << "seed " << seed << " case " << i;
      ++equal;
    }
    engaged += got.engaged();
  }
  EXPECT_GT(engaged, 100000);
  EXPECT_GT(equal, 50) << "hardly ever the same points: nothing was compared";
}

/// Bone with holes, half-covered voxels and every density, looked at by both C++ forms while it is cut away.
TEST(NarrowPhase, PortableAndBestInstructionsGiveTheSameBits) {
  const uint32_t seed = test::seed(43);
  std::mt19937 random(seed);
  ContactScene s("ellipse 6,3 nipple 1,2");
  std::uniform_int_distribution<int> any_byte(0, 255);
  for (auto& code : s.bone.density.writable()) code = static_cast<uint8_t>(any_byte(random));
  const auto best = collide::make_narrow_phase_cpu(s.input());
  const auto portable = collide::make_narrow_phase_cpu(s.input(), collide::Instructions::portable);
  int64_t engaged = 0;
  for (int i = 0; i < 300; ++i) {
    for (int k = 0; k < 20; ++k) {
      const auto brick = static_cast<uint32_t>(random() % s.bone.grid.brick_count());
      uint8_t* coverage = s.bone.coverage.data() + s.bone.grid.brick_base(brick);
      coverage[random() % voxel::brick_voxels] /= static_cast<uint8_t>(1 + random() % 3);
      s.cells.set(brick, voxel::SolidCells::word_of(coverage));
    }
    Pose pose = random_pose(random, 0.0);
    pose.translation_mm = Vec3(8, 8, 8) + random_vector(random, 7.0);
    const QuantisedPose q = quantised(pose);
    const collide::ContactSums got = s.contact(*best, q);
    ASSERT_EQ(got, s.contact(*portable, q)) << "seed " << seed << " case " << i;
    engaged += got.engaged();
  }
  EXPECT_GT(engaged, 100000);
}

/// A layer of so many bricks that their number needs more than 15 bits.
TEST(NarrowPhase, WideGridsGiveTheSameBitsToo) {
  const uint32_t seed = test::seed(44);
  std::mt19937 random(seed);
  const voxel::BoneModel bone = slab({1480, 1464, 8}, 0.25, 1.5, 1.4);
  ASSERT_GT(bone.grid.brick_dims().x() * bone.grid.brick_dims().y(), 32767);
  const auto contact =
      collide::make_contact_shell(shell::make_point_shell(shell::make_tool("sphere 6"), 0.3), 0.25);
  const voxel::BrickDistance distance = voxel::brick_distance(bone);
  const voxel::SolidCells cells(bone);
  const collide::NarrowPhaseInput input{contact, bone, distance, cells};
  const auto best = collide::make_narrow_phase_cpu(input);
  const auto portable = collide::make_narrow_phase_cpu(input, collide::Instructions::portable);
  int64_t engaged = 0;
  for (int i = 0; i < 20; ++i) {
    const Pose pose{rotation_with_z_along(-Vec3::UnitZ()), Vec3(300, 320, 0.8) + random_vector(random, 0.7)};
    const QuantisedPose q = quantised(pose);
    const collide::Voi voi = collide::broad_phase(cells.bounds_mm(), contact.bounds_mm, pose, 0.25);
    collide::ContactSums a, b;
    ASSERT_TRUE(best->contact(q, voi, a) && portable->contact(q, voi, b));
    ASSERT_EQ(a, b) << "seed " << seed << " case " << i;
    engaged += a.engaged();
  }
  EXPECT_GT(engaged, 1000);
}

TEST(NarrowPhase, SumsOfAFlatContactAreThoseOfTheGeometry) {
  ContactScene s("sphere 6,4");
  const auto phase = collide::make_narrow_phase_cpu(s.input());
  Pose grid_from_tool{rotation_with_z_along(-Vec3::UnitZ()), Vec3(8.0, 8.0, 7.0)};
  const collide::ContactSums sums = s.contact(*phase, quantised(grid_from_tool));
  // The apex is 1 mm below the surface: the engaged cap has area 2 pi R h.
  const double area_mm2 = static_cast<double>(sums.cutting.area) / 16.0 * s.shell.cell_area_mm2;
  const double cap_mm2 = 2.0 * 3.14159265 * 6.0 * 1.0;
  EXPECT_NEAR(area_mm2, cap_mm2, 0.06 * cap_mm2);
  EXPECT_EQ(sums.guiding.points, 0);
  const int64_t weight = sums.cutting.first[6];
  EXPECT_EQ(sums.class_weight[static_cast<size_t>(voxel::BoneClass::cortical)], weight);
  EXPECT_EQ(sums.class_density[static_cast<size_t>(voxel::BoneClass::cortical)], 140 * weight);
  EXPECT_EQ(sums.resistance, s.resistances[140] * weight);
  // Edge: of lips that pass radius r so often a turn, per length 1 / r; over the cap 2 pi times its meridian.
  const double edge_mm = static_cast<double>(weight) / 16.0 * s.shell.cell_area_mm2 / collide::edge_radius_mm;
  const double meridian_mm = 6.0 * std::acos(5.0 / 6.0);
  EXPECT_NEAR(edge_mm, 2.0 * 3.14159265 * meridian_mm, 0.06 * edge_mm);

  // Symmetry about the axis: no sideways force, no moment about the apex along z.
  const auto force_z = static_cast<double>(sums.cutting.first[2]);
  EXPECT_GT(force_z, 0.0);
  EXPECT_LT(std::abs(static_cast<double>(sums.cutting.first[0])), 0.02 * force_z);
  EXPECT_LT(std::abs(static_cast<double>(sums.cutting.first[1])), 0.02 * force_z);
}

TEST(NarrowPhase, FarAwayNothingTouches) {
  ContactScene s("sphere 6,4");
  const auto phase = collide::make_narrow_phase_cpu(s.input());
  EXPECT_EQ(s.contact(*phase, quantised({Mat3::Identity(), Vec3(8, 8, 500)})).engaged(), 0);
}

}  // namespace
}  // namespace ream::test
