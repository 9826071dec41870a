#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <iostream>

#include "ct/phantom/phantom.hpp"
#include "reader/ct_files.hpp"
#include "support/temporary_folder.hpp"
#include "unit/reader/changed_dicom.hpp"

namespace ream::reader {
using namespace ct;
namespace {

/// The mean of `n` slices as one, from slice `first` on: what a scanner measures with slices n times as
/// thick.
HuVolume thickened(const HuVolume& fine, int n, int first) {
  HuVolume thick = fine;
  thick.world_from_volume.translation_mm.z() += first * fine.spacing_mm.z();
  thick.dims.z() = (fine.dims.z() - first) / n;
  thick.spacing_mm.z() = n * fine.spacing_mm.z();
  thick.hu.assign(thick.voxel_count(), 0);
  for (int w = 0; w < thick.dims.z(); ++w)
    for (int v = 0; v < thick.dims.y(); ++v)
      for (int u = 0; u < thick.dims.x(); ++u) {
        double sum = 0.0;
        for (int k = 0; k < n; ++k) sum += fine.hu[fine.index(u, v, first + w * n + k)];
        thick.hu[thick.index(u, v, w)] = static_cast<int16_t>(std::floor(sum / n + 0.5));
      }
  return thick;
}

/// HU between voxel centres, trilinear.
double hu_at(const HuVolume& volume, const Vec3& world) {
  const Vec3 p =
      (volume.world_from_volume.inverse().point(world).array() / volume.spacing_mm.array() - 0.5).matrix();
  const Vec3i o = p.array().floor().cast<int>().matrix();
  double sum = 0.0;
  for (int k = 0; k < 8; ++k) {
    const Vec3i corner =
        (o + Vec3i(k & 1, (k >> 1) & 1, k >> 2)).cwiseMax(0).cwiseMin(volume.dims - Vec3i::Ones());
    double weight = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double share = p[axis] - o[axis];
      weight *= ((k >> axis) & 1) != 0 ? share : 1.0 - share;
    }
    sum += weight * volume.hu[volume.index(corner.x(), corner.y(), corner.z())];
  }
  return sum;
}

struct Cost {
  double version_deg = 0.0, inclination_deg = 0.0,
         depth_mm = 0.0;      ///< 19 of 20 places are met within that depth
  double lost_percent = 0.0;  ///< of the places, where no face is met
};

/// The articular face met along its axis at the threshold: plane through it, compared with the plane through
/// the true sphere at the same places.
Cost cost_of(const HuVolume& volume, const GroundTruth& truth, double threshold_hu) {
  const Vec3 lateral = truth.glenoid.lateral, centre = truth.glenoid.centre_mm;
  const Vec3 superior = (Vec3::UnitZ() - lateral.z() * lateral).normalized(),
             across = superior.cross(lateral);
  Eigen::MatrixXd places(0, 3);
  Eigen::VectorXd found(0), exact(0);
  std::vector<double> depths;
  int lost = 0;
  for (int a = -6; a <= 6; ++a)
    for (int b = -6; b <= 6; ++b) {
      const double x = a / 6.0 * 0.40 * truth.glenoid_width_mm, y = b / 6.0 * 0.40 * truth.glenoid_height_mm;
      if ((a * a + b * b) > 36) continue;
      const Vec3 start = centre + x * across + y * superior;
      const Vec3 to_centre = start - truth.articular_sphere_centre_mm;
      const double along = to_centre.dot(lateral);
      // The face is hollow: its sphere's centre lies lateral, the face medial of it.
      const double truth_mm = -along - std::sqrt(along * along - to_centre.squaredNorm() +
                                                 truth.articular_radius_mm * truth.articular_radius_mm);
      bool met_face = false;
      double before = hu_at(volume, start + (truth_mm + 2.0) * lateral);
      for (double t = truth_mm + 1.9; t > truth_mm - 8.0; t -= 0.1) {
        const double here = hu_at(volume, start + t * lateral);
        if (here >= threshold_hu && before < threshold_hu) {
          const double met = t + 0.1 * (here - threshold_hu) / (here - before);
          const auto n = places.rows();
          places.conservativeResize(n + 1, 3);
          found.conservativeResize(n + 1);
          exact.conservativeResize(n + 1);
          places.row(n) << 1.0, x, y;
          found[n] = met;
          exact[n] = truth_mm;
          depths.push_back(std::abs(met - truth_mm));
          met_face = true;
          break;
        }
        before = here;
      }
      lost += !met_face;
    }
  const Eigen::VectorXd off = places.colPivHouseholderQr().solve(found - exact);
  std::sort(depths.begin(), depths.end());
  Cost cost;
  cost.version_deg = std::abs(std::atan(off[1])) * 180.0 / M_PI;
  cost.inclination_deg = std::abs(std::atan(off[2])) * 180.0 / M_PI;
  cost.lost_percent = 100.0 * lost / (static_cast<double>(depths.size()) + lost);
  cost.depth_mm = depths[depths.size() * 95 / 100];
  return cost;
}

/// Over shoulders of all kinds, the largest of each.
Cost worst(int slices_as_one) {
  Cost largest;
  uint64_t seed = 1;
  for (const double version_deg : {-25.0, -12.0, 0.0, 15.0})
    for (const double inclination_deg : {-10.0, 5.0, 20.0}) {
      PhantomParams params;
      params.version_rad = version_deg * M_PI / 180.0;
      params.inclination_rad = inclination_deg * M_PI / 180.0;
      params.spacing_mm = Vec3(0.7, 0.7, 1.0);
      params.field_mm = {{-8.0, -24.0, -40.0}, {33.6, 30.4, 40.0}};
      params.random_seed = seed++;
      const Phantom phantom = make_phantom(params);
      for (const int first : {0, slices_as_one / 2}) {
        const Cost c = cost_of(thickened(phantom.volume, slices_as_one, first), phantom.truth,
                               params.calibration.threshold_hu);
        largest.version_deg = std::max(largest.version_deg, c.version_deg);
        largest.inclination_deg = std::max(largest.inclination_deg, c.inclination_deg);
        largest.depth_mm = std::max(largest.depth_mm, c.depth_mm);
        largest.lost_percent = std::max(largest.lost_percent, c.lost_percent);
      }
    }
  return largest;
}

/// The figures of warn_of_thickness: none is exceeded, none exaggerates by half.
void expect_said(const Cost& c, double inclination_deg, double depth_mm, double lost_percent) {
  std::cout << "version " << c.version_deg << " deg, inclination " << c.inclination_deg << " deg, depth "
            << c.depth_mm << " mm, lost " << c.lost_percent << " %\n";
  EXPECT_LE(c.version_deg, 0.6);
  EXPECT_LE(c.inclination_deg, inclination_deg);
  EXPECT_GE(c.inclination_deg, inclination_deg / 1.5);
  EXPECT_LE(c.depth_mm, depth_mm);
  EXPECT_GE(c.depth_mm, depth_mm / 1.5);
  EXPECT_LE(c.lost_percent, lost_percent);
  EXPECT_GE(c.lost_percent, lost_percent / 1.5);
}

TEST(ThickSlices, CostWhatTheWarningSays) {
  expect_said(worst(1), 0.5, 0.7, 1.2);
  expect_said(worst(5), 3.6, 2.0, 30.0);
  expect_said(worst(8), 4.5, 2.0, 50.0);
}

TEST(ThickSlices, AreWarnedOfFrom5MillimetresOn) {
  HuVolume volume;
  volume.spacing_mm = {0.7, 0.7, 4.9};
  warn_of_thickness(volume, 0.0);
  EXPECT_TRUE(volume.warnings.empty());
  warn_of_thickness(volume, 5.0);  // overlapping slices
  EXPECT_TRUE(test::mentions(volume, "the slices are 5 mm thick: phantoms of 5 mm"));
  volume.spacing_mm.z() = 8.0;
  warn_of_thickness(volume, 0.0);
  EXPECT_TRUE(test::mentions(volume, "the slices are 8 mm thick: phantoms of 8 mm"));
}

}  // namespace
}  // namespace ream::reader
