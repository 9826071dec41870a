#include "bench/validate/plate_measures.hpp"

#include <gtest/gtest.h>

#include "bench/validate/density_measures.hpp"

namespace ream::bench {
namespace {

test::AnalyticGlenoid glenoid_with(double radius_mm, double plate_mm) {
  test::AnalyticGlenoid glenoid;
  glenoid.radius_mm = radius_mm;
  glenoid.plate_mm = plate_mm;
  return glenoid;
}

TEST(TruePlate, OfANearlyFlatFaceIsWhatThePlateIs) {
  const PlateMeasures truth = true_plate(glenoid_with(2e4, 2.9));
  EXPECT_NEAR(truth.thickness_mm, 2.9, 1e-4);
  // The reamer cuts all of the component's footprint, and nowhere through the plate: 0.3 mm more of 2.9 mm.
  EXPECT_NEAR(truth.lost_percent, 100.0 * 0.3 / 2.9, 0.01);
  // Half of it loses half of the plate, but for the width of a ring of the lattice.
  EXPECT_NEAR(truth.preserved_percent, 50.0, 1.5);
  EXPECT_GT(truth.planned_percent, truth.preserved_percent + 10.0);
}

TEST(TruePlate, IsThickerAlongAnAxisThanAcrossACurvedFace) {
  const PlateMeasures truth = true_plate(glenoid_with(36.0, 1.9));
  EXPECT_GT(truth.thickness_mm, 1.9);
  EXPECT_LT(truth.thickness_mm, 2.2);
}

/// Voxels by the formulas, without a CT: what is left of the errors is the program's own.
TEST(MeasuredPlate, ComesNearTheTruthOnVoxelsOfFormulas) {
  const test::AnalyticGlenoid glenoid = glenoid_with(36.0, 1.9);
  const voxel::BoneModel bone = test::bone_of(glenoid, 0.2);
  const PlateMeasures truth = true_plate(glenoid), measured = measured_plate(glenoid, bone);
  EXPECT_NEAR(measured.thickness_mm, truth.thickness_mm, 0.05);
  EXPECT_NEAR(measured.preserved_percent, truth.preserved_percent, 3.0);
  EXPECT_NEAR(measured.planned_percent, truth.planned_percent, 3.0);
  EXPECT_NEAR(measured.lost_percent, truth.lost_percent, 2.0);
}

TEST(MeasuredDensity, IsThatOfTheFormulasOnTheirVoxels) {
  const test::AnalyticGlenoid glenoid = glenoid_with(36.0, 1.9);
  const DensityMeasures measured = measured_density(glenoid, test::bone_of(glenoid, 0.2));
  EXPECT_NEAR(measured.plate_g_cc, glenoid.compact_g_cc, 1e-9);
  EXPECT_NEAR(measured.shell_g_cc, glenoid.compact_g_cc, 1e-9);
  EXPECT_NEAR(measured.core_g_cc, glenoid.spongy_g_cc, 1e-9);
  EXPECT_NEAR(measured.core_deviation_g_cc, 0.0, 1e-6);
  EXPECT_EQ(measured.joint_bone_percent, 0.0);
  EXPECT_NEAR(measured.surface_mm, 0.0, 0.02);
}

}  // namespace
}  // namespace ream::bench
