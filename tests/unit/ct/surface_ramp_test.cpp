#include "ct/build/surface_ramp.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/units.hpp"
#include "ct/build/bone_from_mask.hpp"
#include "support/seed.hpp"
#include "surface/block_mesh.hpp"
#include "unit/surface/volumes.hpp"

namespace ream::ct {
namespace {

/// A ball of bone in muscle, as a scanner with a Gaussian point-spread function shows it; without blur its
/// ramp is one voxel wide.
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
        const double share = ball.blur_mm > 0.0 ? 0.5 * std::erfc(-d / (std::sqrt(2.0) * ball.blur_mm))
                                                : std::clamp(0.5 + d / ball.spacing_mm.minCoeff(), 0.0, 1.0);
        const double hu = ball.muscle_hu + share * (ball.bone_hu - ball.muscle_hu);
        volume.hu.push_back(static_cast<int16_t>(hu + (ball.noise_hu > 0.0 ? noise(random) : 0.0)));
      }
  return volume;
}

/// How far an imported ball is from the true one.
struct Measured {
  double side_edges = 0.0;           ///< farthest from the surface that a voxel is on its wrong side
  std::vector<double> fringe_edges;  ///< how far outside the voxels are that have any coverage there
  double surface_rms_mm = 0.0, surface_worst_mm = 0.0;
  double shading_rms_deg = 0.0;  ///< between a triangle's normal and the ball's, by area
};

Measured measured(const ScannedBall& ball, int upsample, unsigned seed) {
  const HuVolume volume = scan_of(ball, seed);
  const double half_level_hu = 0.5 * (ball.muscle_hu + ball.bone_hu);
  Mask mask(volume.voxel_count());
  for (size_t i = 0; i < mask.size(); ++i) mask[i] = volume.hu[i] >= half_level_hu ? 1 : 0;
  BoneSettings settings;
  settings.upsample = upsample;
  const voxel::BoneModel bone = bone_from_mask(volume, mask, settings, no_progress);
  const double edge_mm = bone.grid.min_spacing_mm();
  Measured result;
  for (size_t i = 0; i < bone.coverage.size(); ++i) {
    const Vec3 centre = bone.grid.world_from_grid.point(bone.grid.centre_mm(bone.grid.coordinates(i)));
    const double d = ball.distance_mm(centre) / edge_mm, coverage = bone.coverage[i] / 255.0;
    if ((coverage > 0.5) != (d > 0.0)) result.side_edges = std::max(result.side_edges, std::abs(d));
    if (coverage > 0.0 && d < 0.0) result.fringe_edges.push_back(-d);
  }
  const TriangleMesh mesh = surface::whole_surface(bone.grid, bone.coverage.data());
  double square = 0.0;
  for (const Vec3f& p : mesh.vertices_mm) {
    const double off_mm = ball.distance_mm(bone.grid.world_from_grid.point(p.cast<double>()));
    result.surface_worst_mm = std::max(result.surface_worst_mm, std::abs(off_mm));
    square += off_mm * off_mm;
  }
  double area = 0.0, turned = 0.0;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices_mm[t[0]].cast<double>(), b = mesh.vertices_mm[t[1]].cast<double>(),
               c = mesh.vertices_mm[t[2]].cast<double>();
    const Vec3 across = bone.grid.world_from_grid.direction((b - a).cross(c - a));
    const Vec3 out = bone.grid.world_from_grid.point((a + b + c) / 3.0) - ball.centre_mm;
    const double angle = std::acos(std::clamp(across.normalized().dot(out.normalized()), -1.0, 1.0));
    area += across.norm();
    turned += across.norm() * angle * angle;
  }
  result.shading_rms_deg = degrees_from_radians(std::sqrt(turned / area));
  result.surface_rms_mm = std::sqrt(square / static_cast<double>(mesh.vertices_mm.size()));
  return result;
}

/// How far noise moves the half level, standard deviation in the scan's voxels, half a voxel outside where
/// the ramp is flatter than at the surface.
double noise_voxels(const ScannedBall& ball) {
  const double edge_mm = ball.spacing_mm.minCoeff(), out_mm = 0.5 * edge_mm,
               contrast_hu = ball.bone_hu - ball.muscle_hu;
  const double slope_per_mm = ball.blur_mm > 0.0
                                  ? std::exp(-0.5 * out_mm * out_mm / (ball.blur_mm * ball.blur_mm)) /
                                        (std::sqrt(2.0 * pi) * ball.blur_mm)
                                  : 1.0 / edge_mm;
  return ball.noise_hu / (contrast_hu * slope_per_mm * edge_mm);
}

/// Coverage outside the ball ends within `bound_edges` but for one voxel in two hundred. Not one of the
/// thousands around the ball has it farther out than noise carries one in 10^10.
void expect_narrow_fringe(const std::vector<double>& fringe_edges, double bound_edges, double noise_edges) {
  constexpr double rare = 6.4;
  ASSERT_FALSE(fringe_edges.empty());
  const auto beyond = std::count_if(fringe_edges.begin(), fringe_edges.end(),
                                    [&](double edges) { return edges >= bound_edges; });
  EXPECT_LE(beyond, noise_edges > 0.0 ? static_cast<std::ptrdiff_t>(fringe_edges.size() / 200) : 0);
  EXPECT_LT(*std::max_element(fringe_edges.begin(), fringe_edges.end()), bound_edges + rare * noise_edges);
}

TEST(SurfaceRamp, OfAScanIsAVoxelWideAboutTheHalfLevelAndHasNoTerraces) {
  const unsigned seed = test::seed();
  for (const double blur_mm : {0.0, 0.25, 0.45})
    for (const double noise_hu : {0.0, 20.0})
      for (const int upsample : {1, 3, 6}) {
        ScannedBall ball;
        ball.blur_mm = blur_mm;
        ball.noise_hu = noise_hu;
        SCOPED_TRACE("upsampled " + std::to_string(upsample) + ", blur " + std::to_string(blur_mm) +
                     ", noise " + std::to_string(noise_hu) + ", seed " + std::to_string(seed));
        const Measured ours = measured(ball, upsample, seed);
        // A quarter of a scan's voxel, a third with noise; a finer voxel is no better than the scan.
        const double scan_voxels = noise_hu > 0.0 ? 0.33 : 0.25;
        EXPECT_LT(ours.side_edges, scan_voxels * upsample);
        expect_narrow_fringe(ours.fringe_edges, (upsample > 1 ? 0.75 : 0.45) + scan_voxels * upsample,
                             noise_voxels(ball) * upsample);
        // Terraces: a fine ramp of 0.9 voxels has over 7 degrees.
        EXPECT_LT(ours.shading_rms_deg, 6.8);
        EXPECT_LT(ours.surface_rms_mm, 0.08 * 0.6);
        EXPECT_LT(ours.surface_worst_mm, 0.4 * 0.6);
      }
}

TEST(SurfaceRamp, OfFlatVoxelsKeepsTheSurfaceBetweenTheirCentres) {
  ScannedBall ball;
  ball.spacing_mm = {0.4, 0.4, 1.0};
  ball.blur_mm = 0.3;
  const Measured flat = measured(ball, 1, 1);
  EXPECT_LT(flat.surface_rms_mm, 0.06);
  EXPECT_LT(flat.surface_worst_mm, 0.2);
}

TEST(SurfaceRamp, OfAStepStaysAStepAndAPlaneKeepsItsPlace) {
  voxel::VoxelGrid grid;
  grid.dims = {8, 8, 8};
  const auto plane = [&](int partial) {
    std::vector<uint8_t> coverage;
    coverage.reserve(512);
    for (int i = 0; i < 512; ++i)
      coverage.push_back(i / 64 < 4 ? 255 : (i / 64 == 4 ? static_cast<uint8_t>(partial) : 0));
    return coverage;
  };
  for (const int partial : {0, 255}) {
    std::vector<uint8_t> coverage = plane(partial);
    redraw_surface_ramp(grid, 0.9, coverage);
    EXPECT_EQ(coverage, plane(partial));
  }
  std::vector<uint8_t> coverage = plane(190);
  redraw_surface_ramp(grid, 0.9, coverage);
  EXPECT_EQ(coverage, plane(190));
}

}  // namespace
}  // namespace ream::ct
