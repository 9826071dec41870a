#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>

#include "case/landmarks.hpp"
#include "case/measures.hpp"
#include "core/file.hpp"
#include "core/hash.hpp"
#include "core/units.hpp"
#include "ct/phantom/phantom_case.hpp"
#include "support/expect_error.hpp"

namespace ream::ct {
namespace {

constexpr PhantomType all_types[] = {PhantomType::a1, PhantomType::a2,          PhantomType::b1,
                                     PhantomType::b2, PhantomType::b3,          PhantomType::c1,
                                     PhantomType::d,  PhantomType::osteophytes, PhantomType::osteoporotic};

PhantomParams coarse(PhantomType type) {
  PhantomParams p;
  p.type = type;
  p.spacing_mm = Vec3::Constant(0.8);
  p.field_mm = {{-16.0, -24.0, -28.0}, {28.0, 28.0, 28.0}};
  p.noise_hu = 0.0;
  return p;
}

int hu_at(const HuVolume& volume, const Vec3& world) {
  const Vec3i o = volume.voxel_at_world(world);
  return volume.contains(o) ? volume.hu[volume.index(o.x(), o.y(), o.z())] : -2000;
}

size_t voxels_over(const HuVolume& volume, int hu) {
  return static_cast<size_t>(
      std::count_if(volume.hu.begin(), volume.hu.end(), [&](int h) { return h >= hu; }));
}

uint64_t hash_of(const PhantomParams& params) {
  const HuVolume volume = make_phantom(params).volume;
  return hash_bytes(std::as_bytes(std::span(volume.hu)));
}

/// Recordings, bench figures and other tests rest on these phantoms: the types came later and change none of
/// their voxels.
TEST(PhantomTypes, TheFirstPhantomsKeepTheirVoxels) {
  EXPECT_EQ(to_hex(hash_of(phantom_preset("demo").params)), "107672db2a30fa84");
  EXPECT_EQ(to_hex(hash_of(phantom_preset("thesis-5-4-2").params)), "295f9524450136c0");
  PhantomParams tilted;
  tilted.side = case_::Side::left;
  tilted.version_rad = radians_from_degrees(-15.0);
  tilted.inclination_rad = radians_from_degrees(9.0);
  tilted.spacing_mm = Vec3::Constant(2.0);
  EXPECT_EQ(to_hex(hash_of(tilted)), "d7aec8d483c7df32");
}

TEST(PhantomTypes, WordsAndBack) {
  for (const PhantomType type : all_types) EXPECT_EQ(phantom_type_from_text(to_text(type)), type);
  test::expect_error(ErrorKind::invalid_input, "osteoporotic", [] { phantom_type_from_text("C3"); });
}

TEST(PhantomTypes, LeftIsTheMirrorImageOfRightVoxelForVoxel) {
  for (const PhantomType type : all_types) {
    SCOPED_TRACE(to_text(type));
    PhantomParams params = coarse(type);
    params.noise_hu = 15.0;
    const Phantom right = make_phantom(params);
    params.side = case_::Side::left;
    const Phantom left = make_phantom(params);
    const Vec3i dims = right.volume.dims;
    size_t different = 0;
    for (int w = 0; w < dims.z(); ++w)
      for (int v = 0; v < dims.y(); ++v)
        for (int u = 0; u < dims.x(); ++u)
          different += right.volume.hu[right.volume.index(u, v, w)] !=
                       left.volume.hu[left.volume.index(dims.x() - 1 - u, v, w)];
    EXPECT_EQ(different, 0u);
    EXPECT_EQ(right.truth.landmarks.superior_rim_mm->x(), -left.truth.landmarks.superior_rim_mm->x());
    EXPECT_EQ(right.truth.landmarks.walch, left.truth.landmarks.walch);
  }
}

TEST(PhantomTypes, CasesOfBothSidesHaveTheSameBoneAndDensities) {
  using Counts = std::array<std::array<size_t, 256>, 256>;  // by coverage and density code
  const auto counts_of = [](PhantomParams params, case_::Side side) {
    params.side = side;
    const auto bone = make_phantom_case("phantom", params, 2).bone;
    auto counts = std::make_unique<Counts>();
    for (size_t i = 0; i < bone.coverage.size(); ++i)
      if (bone.coverage[i] > 0) ++(*counts)[bone.coverage[i]][bone.density[i]];
    return counts;
  };
  for (const PhantomType type : {PhantomType::a1, PhantomType::b2}) {
    PhantomParams params = coarse(type);
    params.noise_hu = 15.0;
    // Whole bricks: a case is padded at one end, where bone that the field cuts off would be met differently.
    params.field_mm = {{-16.8, -25.6, -28.8}, {28.0, 28.8, 28.8}};
    EXPECT_TRUE(*counts_of(params, case_::Side::right) == *counts_of(params, case_::Side::left));
  }
}

TEST(PhantomTypes, LandmarksLieOnTheBoneWithBoneBehindAndNoneBefore) {
  for (const PhantomType type : all_types) {
    SCOPED_TRACE(to_text(type));
    PhantomParams params = coarse(type);
    params.version_rad = radians_from_degrees(-8.0);
    const GroundTruth truth = make_phantom(params).truth;
    const auto density = true_density_g_cc(params);
    const case_::Landmarks& l = truth.landmarks;
    const Vec3 centre = *l.glenoid_centre_mm, lateral = (centre - *l.trigonum_mm).normalized();
    for (const auto& rim : {l.superior_rim_mm, l.inferior_rim_mm, l.anterior_rim_mm, l.posterior_rim_mm}) {
      const Vec3 within = *rim + 1.5 * (centre - *rim).normalized();
      EXPECT_GT(density(within - 2.0 * lateral), 0.0);
      EXPECT_EQ(density(within + 2.0 * lateral), 0.0);
    }
    EXPECT_GT(density(centre - 0.1 * lateral), 0.0);
    EXPECT_EQ(density(centre + 0.1 * lateral), 0.0);
    EXPECT_EQ(density(truth.humeral_head_centre_mm), 0.0) << "not of the scapula";
    const auto written = case_::landmarks_from_json(to_json(truth).at("landmarks"), "truth");
    EXPECT_EQ(written, l);
  }
}

TEST(PhantomTypes, WithoutWearTheRimHasTheGlenoidsSize) {
  const GroundTruth truth = make_phantom(coarse(PhantomType::a1)).truth;
  const case_::Landmarks& l = truth.landmarks;
  EXPECT_NEAR((*l.superior_rim_mm - *l.inferior_rim_mm).norm(), truth.glenoid_height_mm, 1e-6);
  EXPECT_NEAR((*l.anterior_rim_mm - *l.posterior_rim_mm).norm(), truth.glenoid_width_mm, 1e-6);
}

TEST(PhantomTypes, A2IsWornInTheMiddleAndLiesMedial) {
  const Phantom a1 = make_phantom(coarse(PhantomType::a1)), a2 = make_phantom(coarse(PhantomType::a2));
  const Vec3 lateral = (a1.truth.glenoid.centre_mm - a1.truth.spine_root_mm).normalized();
  EXPECT_NEAR((a1.truth.glenoid.centre_mm - a2.truth.glenoid.centre_mm).dot(lateral), 4.0, 1e-9);
  EXPECT_LT(a2.truth.articular_radius_mm, a1.truth.articular_radius_mm);
  const auto before = true_density_g_cc(coarse(PhantomType::a1)),
             after = true_density_g_cc(coarse(PhantomType::a2));
  const Vec3 worn = a1.truth.glenoid.centre_mm - 2.0 * lateral;
  EXPECT_GT(before(worn), 0.0);
  EXPECT_EQ(after(worn), 0.0);
}

TEST(PhantomTypes, B2IsBiconcaveRetrovertedAndScleroticBehind) {
  const PhantomParams params = coarse(PhantomType::b2);
  const Phantom b2 = make_phantom(params);
  const auto& line = b2.truth.landmarks.biconcavity_mm;
  ASSERT_EQ(line.size(), 3u);
  // A ridge: the middle of either concavity lies deeper than the chord along it.
  const auto density = true_density_g_cc(params);
  const Vec3 out = b2.truth.glenoid.lateral;
  for (const auto& [a, b] : {std::pair{line[0], line[1]}, {line[1], line[2]}})
    EXPECT_EQ(density(0.5 * (a + b) - 0.2 * out), 0.0) << "the surface sags below its chord";
  EXPECT_GT(density(line[1] - 0.2 * out), 0.0) << "and stands up to the ridge";
  EXPECT_LT(b2.truth.version_rad, params.version_rad - radians_from_degrees(10.0));
  EXPECT_LT(*b2.truth.neo_version_rad, *b2.truth.paleo_version_rad - radians_from_degrees(10.0));
  const auto healthy = true_density_g_cc(coarse(PhantomType::a1));
  const Vec3 behind = 0.5 * (line[1] + line[2]) - 5.0 * out, ahead = 0.5 * (line[0] + line[1]) - 5.0 * out;
  EXPECT_NEAR(density(behind), 1.1, 1e-9);
  EXPECT_EQ(density(ahead), healthy(ahead));
  EXPECT_EQ(b2.truth.landmarks.walch, "B2");
  EXPECT_GT(
      (b2.truth.humeral_head_centre_mm - b2.truth.glenoid.centre_mm).y(),
      (make_phantom(coarse(PhantomType::a1)).truth.humeral_head_centre_mm - b2.truth.glenoid.centre_mm).y());
}

struct Class {
  PhantomType type;
  double least_version_deg, most_version_deg, least_subluxation_percent, most_subluxation_percent;
};

/// Bercik 2016; of subluxation behind the scapular axis, 50 is centred.
TEST(PhantomTypes, MeasureAsWalchsClassesAreDefined) {
  const Class classes[] = {{PhantomType::a1, -10, 5, 45, 55},
                           {PhantomType::b1, -10, 5, 55, 80},
                           {PhantomType::b3, -31, -15, 65, 95},
                           {PhantomType::c1, -40, -25, 50, 100},
                           {PhantomType::d, 0.5, 20, 0, 40}};
  for (const Class& c : classes) {
    SCOPED_TRACE(to_text(c.type));
    for (const bool anatomical : {false, true}) {
      PhantomParams params = coarse(c.type);
      if (anatomical) params.anatomical = AnatomicalSizes{};
      const GroundTruth truth = make_phantom(params).truth;
      const case_::Measures m = case_::measure(truth.landmarks, params.side);
      const double version_deg = degrees_from_radians(*m.version_3d_rad);
      EXPECT_NEAR(version_deg, degrees_from_radians(truth.version_rad), 1e-6);
      EXPECT_NEAR(*m.inclination_3d_rad, truth.inclination_rad, 1e-8);
      EXPECT_GT(version_deg, c.least_version_deg);
      EXPECT_LT(version_deg, c.most_version_deg);
      EXPECT_GT(*m.subluxation_percent, c.least_subluxation_percent);
      EXPECT_LT(*m.subluxation_percent, c.most_subluxation_percent);
      EXPECT_EQ(truth.landmarks.walch, to_text(c.type));
      EXPECT_FALSE(m.biconcavity);
    }
  }
}

/// 14 +- 4 mm medial at the worst place, against the glenoid that it was; all of it within that one.
TEST(PhantomTypes, B3IsWhatWearHasLeftOfTheNativeVault) {
  const PhantomParams worn = coarse(PhantomType::b3);
  const auto before = true_density_g_cc(coarse(PhantomType::a1)), after = true_density_g_cc(worn);
  const GroundTruth truth = make_phantom(worn).truth;
  EXPECT_EQ(*truth.premorbid_version_rad, worn.version_rad);
  const Vec3 centre = make_phantom(coarse(PhantomType::a1)).truth.glenoid.centre_mm;
  const Vec3 lateral = (centre - truth.spine_root_mm).normalized();
  double worst_mm = 0.0;
  for (double up = -9.0; up <= 6.0; up += 3.0)
    for (double back = -7.5; back <= 7.5; back += 1.5) {
      const Vec3 at = centre + up * truth.glenoid.superior - back * truth.glenoid.anterior;
      double first_before = 0, first_after = 0;
      for (double depth = 25.0; depth >= -10.0; depth -= 0.1) {
        const Vec3 p = at - depth * lateral;
        if (before(p) > 0.0) first_before = depth;
        if (after(p) > 0.0) first_after = depth;
        EXPECT_FALSE(after(p) > 0.0 && before(p) == 0.0) << "bone has grown";
      }
      worst_mm = std::max(worst_mm, first_after - first_before);
    }
  EXPECT_NEAR(worst_mm, 14.0, 4.0);  // within 7.5 mm of the middle
  // Sclerotic behind, under the plate.
  const Vec3 behind =
      *truth.landmarks.posterior_rim_mm +
      5.0 * (*truth.landmarks.glenoid_centre_mm - *truth.landmarks.posterior_rim_mm).normalized();
  EXPECT_GT(after(behind - (worn.plate_mm + 2.0) * lateral), 1.0);
}

TEST(PhantomTypes, OsteophytesAddBoneOutsideTheNativeRimOnly) {
  const Phantom a1 = make_phantom(coarse(PhantomType::a1)),
                more = make_phantom(coarse(PhantomType::osteophytes));
  case_::Landmarks native = a1.truth.landmarks;
  native.walch.clear();
  EXPECT_EQ(more.truth.landmarks, native) << "landmarks lie on native bone";
  const size_t before = voxels_over(a1.volume, 300), after = voxels_over(more.volume, 300);
  EXPECT_GT(static_cast<double>(after - before) * std::pow(0.8, 3), 150.0) << "mm^3";
  const Vec3 centre = a1.truth.glenoid.centre_mm, up = a1.truth.glenoid.superior,
             front = a1.truth.glenoid.anterior, out = a1.truth.glenoid.lateral;
  for (int w = 0; w < a1.volume.dims.z(); ++w)
    for (int v = 0; v < a1.volume.dims.y(); ++v)
      for (int u = 0; u < a1.volume.dims.x(); ++u) {
        const Vec3 p = a1.volume.world_of_centre({u, v, w}) - centre;
        const Vec3 face(p.dot(up), p.dot(front), p.dot(out));
        if (std::hypot(face.x(), face.y()) > 9.0 || face.z() < 0.0) continue;
        ASSERT_EQ(a1.volume.hu[a1.volume.index(u, v, w)], more.volume.hu[more.volume.index(u, v, w)]);
      }
  EXPECT_GT(hu_at(more.volume, *native.inferior_rim_mm - 2.5 * up + 1.0 * out), 300);
  EXPECT_LT(hu_at(a1.volume, *native.inferior_rim_mm - 2.5 * up + 1.0 * out), 100);
}

TEST(PhantomTypes, OsteophytesBelongToTheBone) {
  const auto bone_mm3 = [](PhantomType type) {
    const auto bone = make_phantom_case("phantom", coarse(type), 1).bone;
    return static_cast<double>(bone.filled_voxels()) * bone.grid.voxel_volume_mm3();
  };
  EXPECT_GT(bone_mm3(PhantomType::osteophytes) - bone_mm3(PhantomType::a1), 150.0);
}

TEST(PhantomTypes, OsteoporosisIsLightAndThinInTheSameShape) {
  const PhantomParams params = coarse(PhantomType::osteoporotic);
  const auto poor = true_density_g_cc(params), healthy = true_density_g_cc(coarse(PhantomType::a1));
  const GroundTruth truth = make_phantom(params).truth;
  const Vec3 in = -truth.glenoid.lateral, centre = truth.glenoid.centre_mm;
  EXPECT_NEAR(poor(centre + 6.0 * in) / healthy(centre + 6.0 * in), 0.65, 1e-9);
  EXPECT_LT(poor(centre + 0.5 * in), healthy(centre + 0.5 * in));
  EXPECT_LT(poor(centre + 1.6 * in), 1.0) << "the plate is thinner";
  EXPECT_EQ(healthy(centre + 1.6 * in), 1.5);
  EXPECT_EQ(poor(centre - 0.1 * in), 0.0);
}

}  // namespace
}  // namespace ream::ct
