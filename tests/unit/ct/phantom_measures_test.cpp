#include <gtest/gtest.h>

#include <cstdio>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>

#include "case/measures.hpp"
#include "core/units.hpp"
#include "ct/build/import.hpp"
#include "ct/phantom/phantom_case.hpp"
#include "ct/read/write_volume.hpp"
#include "support/seed.hpp"
#include "support/temporary_folder.hpp"
#include "voxel/bone_model.hpp"

namespace ream::ct {
namespace {

using case_::Landmarks;
using case_::Measures;
using case_::Side;

double degrees(const std::optional<double>& rad) { return degrees_from_radians(rad.value()); }

/// Phantoms of all shapes over the whole range that the program is meant for; sides and types in turn.
std::vector<PhantomParams> seeded_phantoms(unsigned seed, int count, bool native_face) {
  std::mt19937_64 random(seed);
  const auto between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  const PhantomType types[] = {PhantomType::a1, PhantomType::a2, PhantomType::osteophytes,
                               PhantomType::osteoporotic, PhantomType::b2};
  std::vector<PhantomParams> phantoms;
  for (int i = 0; i < count; ++i) {
    PhantomParams p;
    p.side = i % 2 ? Side::left : Side::right;
    p.type = types[i / 2 % (native_face ? 4 : 5)];
    p.version_rad = radians_from_degrees(between(-25, 15));
    p.inclination_rad = radians_from_degrees(between(-10, 20));
    p.glenoid_radius_mm = between(30, 40);
    p.glenoid_height_mm = between(32, 42);
    p.glenoid_width_mm = between(21, 29);
    p.scapular_plane_rad = radians_from_degrees(between(20, 45));
    p.random_seed = random();
    // What is true of a phantom does not depend on its voxels.
    p.spacing_mm = Vec3::Constant(8.0);
    p.field_mm = {Vec3::Constant(-16.0), Vec3::Constant(16.0)};
    phantoms.push_back(p);
  }
  return phantoms;
}

struct Worst {
  double largest = 0, sum = 0;
  int count = 0;
  void take(double error) {
    largest = std::max(largest, std::abs(error));
    sum += std::abs(error);
    ++count;
  }
  void print(const char* what) const {
    std::printf("%s: largest %.3g, mean %.3g, of %d\n", what, largest, sum / count, count);
  }
};

TEST(MeasuredPhantoms, FiftyFromIdealLandmarks) {
  const uint32_t seed = test::seed(7001);
  SCOPED_TRACE("random seed " + std::to_string(seed));
  Worst version, inclination, friedman_version, friedman_inclination;
  for (const PhantomParams& params : seeded_phantoms(seed, 50, true)) {
    const GroundTruth truth = make_phantom(params).truth;
    const Measures m = case_::measure(truth.landmarks, params.side);
    version.take(degrees(m.version_3d_rad) - degrees_from_radians(params.version_rad));
    inclination.take(degrees(m.inclination_3d_rad) - degrees_from_radians(params.inclination_rad));
    friedman_version.take(degrees(m.version_friedman_rad) - degrees(m.version_3d_rad));
    friedman_inclination.take(degrees(m.inclination_friedman_rad) - degrees(m.inclination_3d_rad));
    EXPECT_TRUE(m.missing.empty());
    EXPECT_NEAR(*m.subluxation_glenoid_percent, 50.0, 1e-6) << "the head is centred on its face";
  }
  version.print("3D version error in degrees");
  inclination.print("3D inclination error in degrees");
  friedman_version.print("Friedman version less 3D version in degrees");
  friedman_inclination.print("Friedman inclination less 3D inclination in degrees");
  EXPECT_LT(version.largest, 0.3);
  EXPECT_LT(inclination.largest, 0.3);
}

TEST(MeasuredPhantoms, FiftyBiconcaveAndOtherOnesAgreeWithTheirTruth) {
  const uint32_t seed = test::seed(7002);
  SCOPED_TRACE("random seed " + std::to_string(seed));
  for (const PhantomParams& params : seeded_phantoms(seed, 50, false)) {
    const GroundTruth truth = make_phantom(params).truth;
    const Measures m = case_::measure(truth.landmarks, params.side);
    EXPECT_NEAR(degrees(m.version_3d_rad), degrees_from_radians(truth.version_rad), 1e-6);
    EXPECT_NEAR(degrees(m.inclination_3d_rad), degrees_from_radians(truth.inclination_rad), 1e-6);
    EXPECT_EQ(m.biconcavity.has_value(), params.type == PhantomType::b2);
    if (!m.biconcavity) continue;
    EXPECT_NEAR(m.biconcavity->paleo_version_rad, *truth.paleo_version_rad, 1e-9);
    EXPECT_NEAR(m.biconcavity->neo_version_rad, *truth.neo_version_rad, 1e-9);
    EXPECT_EQ(*truth.premorbid_version_rad, params.version_rad);
    EXPECT_LT(degrees(m.version_3d_rad), degrees_from_radians(params.version_rad) - 8.0);
    EXPECT_GT(degrees(m.biconcavity->between_rad), 8.0);
    EXPECT_GT(*m.subluxation_percent, 55.0) << "the head has gone posterior";
    EXPECT_GT(*m.subluxation_glenoid_percent, 50.0);
  }
}

/// A small field about the glenoid at the voxel size of a good CT.
PhantomParams scanned(PhantomParams params) {
  params.spacing_mm = Vec3::Constant(0.6);
  params.field_mm = {{-13.2, -21.0, -25.8}, {26.4, 25.2, 25.8}};
  return params;
}

case_::Case segmented(const PhantomParams& params) {
  PhantomParams p = params;
  if (p.type == PhantomType::osteoporotic) p.calibration.threshold_hu = 100.0;
  return make_phantom_case("phantom", p, 2);
}

/// A rim landmark as somebody finds it on the segmented surface: seen straight onto the face, a little within
/// the outline, where the rounding of the rim has ended.
Vec3 found_on(const case_::Case& c, const Vec3& rim, const Vec3& centre, const Vec3& into_face) {
  constexpr double within_mm = 1.5, from_mm = 6.0;
  const Vec3 p = rim + within_mm * (centre - rim).normalized();
  const auto hit = case_::surface_along(c.bone, p - from_mm * into_face, into_face);
  EXPECT_TRUE(hit);
  return hit.value_or(p);
}

TEST(MeasuredPhantoms, TenFromLandmarksOnTheSegmentedSurface) {
  const uint32_t seed = test::seed(7003);
  SCOPED_TRACE("random seed " + std::to_string(seed));
  Worst version, inclination;
  for (const PhantomParams& params : seeded_phantoms(seed, 10, true)) {
    const PhantomParams fine = scanned(params);
    const GroundTruth truth = make_phantom(params).truth;
    const case_::Case c = segmented(fine);
    Landmarks l = truth.landmarks;
    const Vec3 centre = *l.glenoid_centre_mm, into_face = -truth.glenoid.lateral;
    for (auto* rim : {&l.superior_rim_mm, &l.inferior_rim_mm, &l.anterior_rim_mm, &l.posterior_rim_mm})
      *rim = found_on(c, **rim, centre, into_face);
    const Measures m = case_::measure(l, params.side);
    version.take(degrees(m.version_3d_rad) - degrees_from_radians(params.version_rad));
    inclination.take(degrees(m.inclination_3d_rad) - degrees_from_radians(params.inclination_rad));
  }
  version.print("3D version error on the surface in degrees");
  inclination.print("3D inclination error on the surface in degrees");
  EXPECT_LT(version.largest, 0.3);
  EXPECT_LT(inclination.largest, 0.3);
}

TEST(MeasuredPhantoms, AMirroredCaseHasIdenticalFigures) {
  const uint32_t seed = test::seed(7004);
  SCOPED_TRACE("random seed " + std::to_string(seed));
  for (PhantomParams params : seeded_phantoms(seed, 50, false)) {
    params.side = Side::right;
    const GroundTruth right = make_phantom(params).truth;
    params.side = Side::left;
    const GroundTruth left = make_phantom(params).truth;
    EXPECT_EQ(case_::to_json(case_::measure(right.landmarks, Side::right)).dump(),
              case_::to_json(case_::measure(left.landmarks, Side::left)).dump());
    EXPECT_EQ(right.version_rad, left.version_rad);
  }
}

/// What density truly is at a place where it is even: within 8 % the same at all 26 neighbours two voxels
/// away (spongy bone changes slowly, borders between tissues by far more). 0 elsewhere.
double even_density(const std::function<double(const Vec3&)>& truth, const Vec3& world, double reach_mm) {
  const double here = truth(world);
  for (int i = 0; here > 0.0 && i < 27; ++i) {
    const Vec3 by = reach_mm * Vec3(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    if (std::abs(truth(world + by) - here) > 0.08 * here) return 0.0;
  }
  return here;
}

/// Relative errors of density inside the scapula, of voxels and of regions of 3 x 3 x 3 of them.
struct DensityErrors {
  Worst voxel, region;
};

DensityErrors density_errors(const case_::Case& c, const PhantomParams& params) {
  const auto truth = true_density_g_cc(params);
  const auto& grid = c.bone.grid;
  DensityErrors errors;
  constexpr int edge = 3, border = 3, voxels = edge * edge * edge;
  for (int w = border; w + edge + border < grid.dims.z(); w += edge)
    for (int v = border; v + edge + border < grid.dims.y(); v += edge)
      for (int u = border; u + edge + border < grid.dims.x(); u += edge) {
        double measured = 0, expected = 0;
        int even = 0;
        for (int i = 0; i < voxels; ++i) {
          const Vec3i o(u + i % edge, v + i / edge % edge, w + i / (edge * edge));
          if (c.bone.coverage[grid.index(o)] < 255) continue;
          const double here = even_density(truth, grid.world_from_grid.point(grid.centre_mm(o)),
                                           2.0 * grid.spacing_mm.maxCoeff());
          if (here == 0.0) continue;
          const double density = voxel::density_g_cc(c.bone.density[grid.index(o)]);
          errors.voxel.take(density / here - 1.0);
          measured += density;
          expected += here;
          ++even;
        }
        if (even == voxels) errors.region.take(measured / expected - 1.0);
      }
  return errors;
}

TEST(PhantomDensity, WithinTwoPercentThroughTheImport) {
  const uint32_t seed = test::seed(7005);
  SCOPED_TRACE("random seed " + std::to_string(seed));
  const test::TemporaryFolder folder;
  for (PhantomParams params : seeded_phantoms(seed, 10, false)) {
    SCOPED_TRACE(to_text(params.type) + " " + case_::to_text(params.side));
    params = scanned(params);
    params.noise_hu = 0.0;
    ImportOptions options;
    options.side = params.side;
    options.segmentation.threshold_hu = 100.0;
    options.build.upsample = 1;
    options.build.around_glenoid = false;
    const Phantom phantom = make_phantom(params);
    options.segmentation.seeds.scapula_mm =
        phantom.truth.glenoid.centre_mm - 5.0 * phantom.truth.glenoid.lateral;
    const auto file = folder.path() / "ct.nrrd";
    write_volume_file(phantom.volume, file);
    const DensityErrors errors = density_errors(import_ct(file, "phantom", options).made, params);
    std::printf("%s %s: ", to_text(params.type).c_str(), case_::to_text(params.side).c_str());
    errors.voxel.print("density error of voxels without noise");
    ASSERT_GT(errors.voxel.count, 500);
    EXPECT_LT(errors.voxel.largest, 0.02);
  }
}

TEST(PhantomDensity, WithNoiseRegionsAreWithinTwoPercentOnAverage) {
  PhantomParams params = scanned({});
  params.noise_hu = 15.0;
  const DensityErrors errors = density_errors(make_phantom_case("phantom", params, 1), params);
  errors.voxel.print("density error of voxels with noise of 15 HU");
  errors.region.print("density error of regions of 3 x 3 x 3 voxels of 0.6 mm");
  ASSERT_GT(errors.region.count, 20);
  EXPECT_LT(errors.region.sum / errors.region.count, 0.02);
}

}  // namespace
}  // namespace ream::ct
