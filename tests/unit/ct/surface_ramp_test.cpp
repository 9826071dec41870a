#include "ct/build/surface_ramp.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "ct/build/bone_from_mask.hpp"
#include "support/seed.hpp"

namespace ream::ct {
namespace {

/// A ball of bone in muscle, as a scanner with a Gaussian point-spread function shows it.
struct ScannedBall {
  Vec3 spacing_mm{0.6, 0.6, 0.6};
  double blur_mm = 0.45, noise_hu = 0.0, muscle_hu = 60.0, bone_hu = 1100.0;
  Vec3 centre_mm{12.3, 11.8, 12.1};
  double radius_mm = 8.0;

  /// Positive inside.
  double distance_mm(const Vec3& p) const { return radius_mm - (p - centre_mm).norm(); }
};

HuVolume scan_of(const ScannedBall& ball, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, ball.noise_hu);
  HuVolume volume;
  volume.spacing_mm = ball.spacing_mm;
  for (int axis = 0; axis < 3; ++axis)
    volume.dims[axis] = static_cast<int>(std::ceil(24.0 / ball.spacing_mm[axis]));
  for (int w = 0; w < volume.dims.z(); ++w)
    for (int v = 0; v < volume.dims.y(); ++v)
      for (int u = 0; u < volume.dims.x(); ++u) {
        const double d = ball.distance_mm(volume.world_of_centre({u, v, w}));
        const double share = 0.5 * std::erfc(-d / (std::sqrt(2.0) * ball.blur_mm));
        const double hu = ball.muscle_hu + share * (ball.bone_hu - ball.muscle_hu);
        volume.hu.push_back(static_cast<int16_t>(hu + (ball.noise_hu > 0.0 ? noise(random) : 0.0)));
      }
  return volume;
}

/// Everywhere within `tolerance` edges of the ramp that the true surface has, and none of it beyond.
void expect_ramp(const ScannedBall& ball, int upsample, double tolerance, unsigned seed) {
  SCOPED_TRACE("upsampled " + std::to_string(upsample) + ", blur " + std::to_string(ball.blur_mm) +
               ", noise " + std::to_string(ball.noise_hu) + ", seed " + std::to_string(seed));
  const HuVolume volume = scan_of(ball, seed);
  const double half_level_hu = 0.5 * (ball.muscle_hu + ball.bone_hu);
  Mask mask(volume.voxel_count());
  for (size_t i = 0; i < mask.size(); ++i) mask[i] = volume.hu[i] >= half_level_hu ? 1 : 0;
  BoneSettings settings;
  settings.upsample = upsample;
  const voxel::BoneModel bone = bone_from_mask(volume, mask, settings, no_progress);
  const double edge_mm = bone.grid.min_spacing_mm();
  double worst_edges = 0.0, fringe_edges = 0.0;
  size_t at_surface = 0;
  for (int w = 0; w < bone.grid.dims.z(); ++w)
    for (int v = 0; v < bone.grid.dims.y(); ++v)
      for (int u = 0; u < bone.grid.dims.x(); ++u) {
        const Vec3 centre = bone.grid.world_from_grid.point(bone.grid.centre_mm({u, v, w}));
        const double d = ball.distance_mm(centre) / edge_mm;
        const double coverage = bone.coverage[bone.grid.index(u, v, w)] / 255.0;
        worst_edges = std::max(worst_edges, std::abs(coverage - std::clamp(0.5 + d, 0.0, 1.0)));
        if (coverage > 0.0 && d < 0.0) fringe_edges = std::max(fringe_edges, -d);
        at_surface += coverage > 0.0 && coverage < 1.0;
      }
  EXPECT_LT(worst_edges, tolerance);
  EXPECT_LT(fringe_edges, 0.5 + tolerance);
  EXPECT_GT(at_surface, 1000u);
}

TEST(SurfaceRamp, OfAScanIsOneVoxelWideAboutTheHalfLevel) {
  const unsigned seed = test::seed();
  for (const double blur_mm : {0.25, 0.45})
    for (const int upsample : {1, 3, 6}) {
      ScannedBall ball;
      ball.blur_mm = blur_mm;
      expect_ramp(ball, upsample, 0.25 * upsample, seed);
      ball.noise_hu = 20.0;
      expect_ramp(ball, upsample, 0.30 * upsample, seed);
    }
}

TEST(SurfaceRamp, IsOneSmallestEdgeWideForFlatVoxelsToo) {
  ScannedBall ball;
  ball.spacing_mm = {0.4, 0.4, 1.0};
  ball.blur_mm = 0.3;
  expect_ramp(ball, 1, 0.3, 1);
}

TEST(SurfaceRamp, OfAStepStaysAStepAndAPlaneKeepsItsPlace) {
  voxel::VoxelGrid grid;
  grid.dims = {8, 8, 8};
  const auto plane = [&](int partial) {
    std::vector<uint8_t> coverage;
    for (int i = 0; i < 512; ++i)
      coverage.push_back(i / 64 < 4 ? 255 : (i / 64 == 4 ? static_cast<uint8_t>(partial) : 0));
    return coverage;
  };
  for (const int partial : {0, 255}) {
    std::vector<uint8_t> coverage = plane(partial);
    redraw_surface_ramp(grid, coverage);
    EXPECT_EQ(coverage, plane(partial));
  }
  std::vector<uint8_t> coverage = plane(190);
  redraw_surface_ramp(grid, coverage);
  for (int i = 0; i < 64; ++i) {
    EXPECT_EQ(coverage[static_cast<size_t>(192 + i)], 255);
    EXPECT_EQ(coverage[static_cast<size_t>(320 + i)], 0);
    EXPECT_NEAR(coverage[static_cast<size_t>(256 + i)], 128 + 255.0 * 62.5 / 190.0, 1.0);
  }
}

}  // namespace
}  // namespace ream::ct
