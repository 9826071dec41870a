#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "core/units.hpp"

#include <Eigen/Geometry>

#include "render/snapshot.hpp"
#include "support/places.hpp"
#include "support/small_run.hpp"
#include "surface/block_mesh.hpp"

namespace ream::test {
namespace {

constexpr double radius_mm = 8.0;

/// Bone of one density behind a plane through the middle of the grid that no voxel axis is square to.
struct Block {
  voxel::BoneModel bone;
  case_::Plan plan;
};

Block block(const Vec3i& dims, double voxel_mm, const Vec3& outward, double density_g_cc) {
  Block b;
  voxel::VoxelGrid grid;
  grid.dims = dims;
  grid.spacing_mm = Vec3::Constant(voxel_mm);
  b.bone = voxel::make_bone(grid);
  const Vec3 entry = grid.bounds_mm().centre();
  for (size_t i = 0; i < b.bone.coverage.size(); ++i) {
    const double outside = (grid.centre_mm(grid.coordinates(i)) - entry).dot(outward) / voxel_mm;
    b.bone.coverage[i] = static_cast<uint8_t>(std::clamp(127.5 - 255.0 * outside, 0.0, 255.0));
    b.bone.density.writable()[i] = voxel::density_code(density_g_cc);
  }
  b.plan.entry_mm = entry;
  b.plan.axis_direction = -outward;
  b.plan.pilot_hole.reset();
  return b;
}

struct Case {
  const char* name;
  Vec3 outward;
  double density_g_cc, voxel_mm, duration_s;
  const char* backend = "cpu";
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

/// Distance of the reamed surface's corners from the sphere, voxels.
struct Deviation {
  double rms = 0.0, mean = 0.0, largest = 0.0;
  size_t corners = 0;
};

Deviation deviation(const TriangleMesh& surface, const Case& c, const Vec3& centre_mm, const Vec3& entry_mm) {
  Deviation d;
  double sum = 0.0, squares = 0.0;
  for (const Vec3f& v : surface.vertices_mm) {
    const Vec3 p = v.cast<double>();
    // The bowl, without the voxel and a half beside its rim, where the plane begins.
    if ((p - entry_mm).dot(c.outward) > -1.5 * c.voxel_mm ||
        (p - centre_mm).norm() > radius_mm + 3.0 * c.voxel_mm)
      continue;
    const double off = ((p - centre_mm).norm() - radius_mm) / c.voxel_mm;
    sum += off;
    squares += off * off;
    d.largest = std::max(d.largest, std::abs(off));
    ++d.corners;
  }
  const auto n = static_cast<double>(d.corners);
  d.rms = std::sqrt(squares / n);
  d.mean = sum / n;
  return d;
}

void draw(const TriangleMesh& surface, const Case& c, const Vec3& target_mm) {
  render::Layer layer;
  layer.mesh = &surface;
  render::Camera camera;
  camera.target_mm = target_mm;
  camera.eye_mm = target_mm + 22.0 * (c.outward + 0.45 * c.outward.unitOrthogonal()).normalized();
  camera.up = c.outward.unitOrthogonal();
  render::write_png(build_folder() + "/reamed_surface_" + c.name + ".png",
                    render::draw({layer}, camera, 900, 700));
}

class ReamedSurface : public ::testing::TestWithParam<Case> {};

TEST_P(ReamedSurface, IsTheSphereAndHoldsItsVolumeAndNeverLosesContact) {
  const Case& c = GetParam();
  Block b = block({104, 104, 104}, c.voxel_mm, c.outward, c.density_g_cc);
  SmallRun run(std::move(b.bone), b.plan, "sphere 8,6", steady_push(52.0, c.duration_s), c.backend);
  const auto reports = run.run();
  ASSERT_EQ(reports.size(), static_cast<size_t>(std::lround(c.duration_s * 1000.0)));

  size_t first = 0;
  while (first < reports.size() && !reports[first].engaged) ++first;
  ASSERT_LT(first, 500u);
  int64_t levels = 0;
  for (const auto& r : reports) {
    EXPECT_TRUE(r.engaged || r.tick < first) << "contact is lost in tick " << r.tick;
    for (const int64_t removed : r.coverage_removed) levels += removed;
  }
  EXPECT_NEAR(reports.back().thrust_n, 52.0, 1.0);

  const Pose tool = dequantised(reports.back().grid_from_tool);
  const Vec3 axis = tool.rotation.col(2), centre = tool.translation_mm - radius_mm * axis;
  const double depth_mm = radius_mm - (centre - b.plan.entry_mm).dot(c.outward);
  ASSERT_GT(depth_mm, 0.8);
  ASSERT_LT(depth_mm, 2.6) << "the bowl is wider than the cutting cap";
  const double cap_mm3 = pi * depth_mm * depth_mm * (radius_mm - depth_mm / 3.0);
  const double removed_mm3 = static_cast<double>(levels) / 255.0 * run.bone.grid.voxel_volume_mm3();

  const TriangleMesh surface = surface::whole_surface(run.bone.grid, run.bone.coverage.data());
  const Deviation d = deviation(surface, c, centre, b.plan.entry_mm);
  std::cout << c.name << ": " << depth_mm << " mm deep, " << d.corners << " corners, RMS " << d.rms
            << " voxel, mean " << d.mean << ", largest " << d.largest << "; volume " << removed_mm3
            << " mm3, " << 100.0 * (removed_mm3 / cap_mm3 - 1.0) << " % off the cap's\n";
  draw(surface, c, b.plan.entry_mm);
  EXPECT_GT(d.corners, 1000u);
  EXPECT_LE(d.rms, 0.15);
  EXPECT_LE(d.largest, 0.5) << "a step";
  EXPECT_NEAR(removed_mm3, cap_mm3, 0.005 * cap_mm3);
}

const Vec3 upright = Vec3::UnitZ();
const Vec3 askew = Vec3(0.3, -0.5, 0.8).normalized();
const Vec3 steep = Vec3(0.7, 0.55, 0.5).normalized();

INSTANTIATE_TEST_SUITE_P(Blocks, ReamedSurface,
                         ::testing::Values(Case{"cancellous_upright", upright, 0.5, 0.15, 6.0},
                                           Case{"cancellous_askew", askew, 0.5, 0.15, 6.0},
                                           Case{"soft_steep", steep, 0.3, 0.15, 5.0},
                                           Case{"cortical_askew", askew, 1.4, 0.15, 40.0},
                                           Case{"cancellous_steep_opencl", steep, 0.6, 0.15, 7.0, "opencl"}),
                         [](const auto& name_of) { return std::string(name_of.param.name); });

}  // namespace
}  // namespace ream::test
