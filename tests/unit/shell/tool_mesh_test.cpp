#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <random>

#include "geometry/mesh_io.hpp"
#include "shell/meridian.hpp"
#include "shell/mesh_tool.hpp"
#include "shell/tool.hpp"
#include "support/expect_error.hpp"
#include "support/random_pose.hpp"
#include "support/seed.hpp"
#include "support/shared_data.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_meshes.hpp"

namespace ream::shell {
namespace {

constexpr uint32_t tool_mesh_seed = 20183;

/// The front of the profile at a radius.
double front_z_mm(const ToolProfile& profile, double radius_mm) {
  for (size_t i = 0; i + 1 < profile.points.size(); ++i) {
    const ProfilePoint &a = profile.points[i], &b = profile.points[i + 1];
    if (a.radius_mm <= radius_mm && radius_mm < b.radius_mm)
      return a.z_mm + (radius_mm - a.radius_mm) / (b.radius_mm - a.radius_mm) * (b.z_mm - a.z_mm);
  }
  return std::nan("");
}

TEST(MeshEnvelope, IsTheHighestOverAllAngles) {
  std::mt19937 random(test::seed(tool_mesh_seed));
  const TriangleMesh mesh =
      test::random_triangles(random, 6, 10.0f).transformed({Mat3::Identity(), Vec3(-4.0, -3.0, 0.0)});
  const MeshEnvelope envelope(mesh);
  // Points set densely in the triangles, sorted into rings.
  const double ring_mm = 0.02;
  std::vector<double> highest(1000, -1e300), lowest(1000, 1e300);
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices_mm[t[0]].cast<double>(), b = mesh.vertices_mm[t[1]].cast<double>(),
               c = mesh.vertices_mm[t[2]].cast<double>();
    const int n = 1200;
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n - i; ++j) {
        const Vec3 p = a + (b - a) * i / n + (c - a) * j / n;
        const auto ring = static_cast<size_t>(std::hypot(p.x(), p.y()) / ring_mm);
        highest[ring] = std::max(highest[ring], p.z());
        lowest[ring] = std::min(lowest[ring], p.z());
      }
  }
  int compared = 0;
  for (size_t ring = 0; ring < 600; ++ring) {
    const double r = (static_cast<double>(ring) + 0.5) * ring_mm;
    if (highest[ring] < -1e299 || !std::isfinite(envelope.top_mm(r))) continue;
    // Between two rings the surface may be steep; the ring's own range decides.
    double top = -1e300, bottom = 1e300;
    for (int k = 0; k <= 10; ++k) {
      top = std::max(top, envelope.top_mm(r + (0.1 * k - 0.5) * ring_mm));
      bottom = std::min(bottom, envelope.bottom_mm(r + (0.1 * k - 0.5) * ring_mm));
    }
    EXPECT_NEAR(top, highest[ring], 0.1) << "radius " << r << " seed " << test::seed(tool_mesh_seed);
    EXPECT_NEAR(bottom, lowest[ring], 0.1) << "radius " << r << " seed " << test::seed(tool_mesh_seed);
    ++compared;
  }
  EXPECT_GT(compared, 100);
}

TEST(MeshEnvelope, BoxIsFlatOutToItsCorners) {
  const MeshEnvelope envelope(test::box_mesh({2.0f, 3.0f, 1.0f}));
  EXPECT_NEAR(envelope.max_radius_mm(), std::sqrt(13.0), 1e-6);
  EXPECT_EQ(envelope.min_radius_mm(), 0.0);
  for (const double r : {0.0, 1.0, 2.5, 3.2, 3.6}) {
    EXPECT_DOUBLE_EQ(envelope.top_mm(r), 1.0) << r;
    EXPECT_DOUBLE_EQ(envelope.bottom_mm(r), -1.0) << r;
  }
  EXPECT_FALSE(std::isfinite(envelope.top_mm(3.7)));
}

class MeshOfATool : public testing::TestWithParam<const char*> {};

/// A revolved profile, moved anywhere and saved, is measured back without being told its axis.
TEST_P(MeshOfATool, IsMeasuredBack) {
  const Tool original = make_tool(GetParam());
  std::mt19937 random(test::seed(tool_mesh_seed));
  for (int round = 0; round < 3; ++round) {
    const Pose mesh_from_tool = test::random_pose(random);
    const test::TemporaryFolder folder;
    const auto path = folder.path() / "tool.ply";
    write_ply(path, revolve(original.profile, 256).transformed(mesh_from_tool));

    const Tool tool = make_tool(path.string());
    const Pose found = tool.tool_from_mesh.inverse();
    EXPECT_LT((found.direction(Vec3::UnitZ()) - mesh_from_tool.direction(Vec3::UnitZ())).norm(), 1e-4);
    EXPECT_LT((found.translation_mm - mesh_from_tool.translation_mm).norm(), 0.015)
        << "seed " << test::seed(tool_mesh_seed);
    EXPECT_NEAR(tool.profile.max_radius_mm(), original.profile.max_radius_mm(), 2e-3);
    for (size_t i = 0; i + 1 < original.profile.points.size(); ++i) {
      const ProfilePoint &a = original.profile.points[i], &b = original.profile.points[i + 1];
      const double r = 0.5 * (a.radius_mm + b.radius_mm), z = 0.5 * (a.z_mm + b.z_mm);
      const MeridianHit hit = nearest_on_profile(tool.profile, r, z);
      EXPECT_LT(std::abs(hit.signed_distance_mm), 0.02) << r << " " << z;
      // The last 10 um before the largest radius cannot be told from the side wall.
      if (r < original.profile.max_radius_mm() - 0.015 || original.profile.roles[i] != SurfaceRole::cutting) {
        EXPECT_EQ(tool.profile.roles[hit.segment], original.profile.roles[i]) << r << " " << z;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Tools, MeshOfATool,
                         testing::Values("ellipse 18.25,9 nipple 3,8", "sphere 20", "thesis",
                                         "sphere 30,12 back 7"));

TEST(MeshTool, ThesisReamerMatchesItsMeasurements) {
  const auto path = test::shared_data("mesh/reamer_4006.stl");
  REAM_SKIP_WITHOUT(path);
  const Tool tool = make_tool(path.string());
  const Pose mesh_from_tool = tool.tool_from_mesh.inverse();
  EXPECT_LT((mesh_from_tool.direction(Vec3::UnitZ()) - Vec3::UnitX()).norm(), 1e-4);
  // Centre of the circle through the vertices of the nipple's and the side wall's rings.
  EXPECT_LT((mesh_from_tool.translation_mm - Vec3(451.2636, 133.8804, 92.3180)).norm(), 0.003);

  const ToolProfile& profile = tool.profile;
  EXPECT_NEAR(profile.max_radius_mm(), 18.25, 0.003);
  EXPECT_NEAR(profile.max_z_mm(), 8.0, 0.003);
  double nipple_radius = 0.0, cutting_radius = 0.0;
  for (size_t i = 0; i < profile.roles.size(); ++i) {
    if (profile.roles[i] == SurfaceRole::guiding) nipple_radius = profile.points[i + 1].radius_mm;
    if (profile.roles[i] == SurfaceRole::cutting) cutting_radius = profile.points[i + 1].radius_mm;
  }
  EXPECT_NEAR(nipple_radius, 3.0, 0.003);
  EXPECT_NEAR(cutting_radius, 18.25, 0.003);
  for (double r = 3.1; r < 6.4; r += 0.1) EXPECT_NEAR(front_z_mm(profile, r), 0.0, 0.005) << r;

  // Circle fitted to the arc: r^2 + z^2 = 2 rc r + 2 zc z + k.
  std::vector<ProfilePoint> arc;
  for (double r = 6.8; r < 18.2; r += 0.05) arc.push_back({r, front_z_mm(profile, r)});
  Eigen::MatrixXd rows(static_cast<long>(arc.size()), 3);
  Eigen::VectorXd right(static_cast<long>(arc.size()));
  for (long i = 0; i < rows.rows(); ++i) {
    const ProfilePoint& p = arc[static_cast<size_t>(i)];
    rows.row(i) << 2.0 * p.radius_mm, 2.0 * p.z_mm, 1.0;
    right[i] = p.radius_mm * p.radius_mm + p.z_mm * p.z_mm;
  }
  const Eigen::Vector3d fit = rows.colPivHouseholderQr().solve(right);
  const double radius = std::sqrt(fit[2] + fit[0] * fit[0] + fit[1] * fit[1]);
  // A circle fitted to the file's own vertices on the arc has 5.852 and 16.071 mm, with residuals to 0.011
  // mm.
  EXPECT_NEAR(fit[0], 5.852, 0.05);
  EXPECT_NEAR(radius, 16.071, 0.05);
  for (const ProfilePoint& p : arc)
    EXPECT_NEAR(std::hypot(p.radius_mm - fit[0], p.z_mm - fit[1]), radius, 0.02) << p.radius_mm;
}

TEST(MeshTool, GivenAxisGivesTheSameReamer) {
  const auto path = test::shared_data("mesh/reamer_4006.stl");
  REAM_SKIP_WITHOUT(path);
  const Tool estimated = make_tool(path.string());
  const Tool given = make_tool(path.string(), ToolAxis{{0.0, 133.8804, 92.3180}, Vec3(2.0, 0.0, 0.0)});
  EXPECT_LT(
      (estimated.tool_from_mesh.inverse().translation_mm - given.tool_from_mesh.inverse().translation_mm)
          .norm(),
      0.003);
  for (double r = 0.05; r < 18.2; r += 0.1)
    if (std::abs(r - 3.0) > 0.05) {
      EXPECT_NEAR(front_z_mm(estimated.profile, r), front_z_mm(given.profile, r), 0.01) << r;
    }
}

TEST(MeshTool, EveryVertexLiesWithinTheEnvelope) {
  const auto path = test::shared_data("mesh/reamer_4006.stl");
  REAM_SKIP_WITHOUT(path);
  const Tool tool = make_tool(path.string());
  for (const Vec3f& v : tool.mesh.vertices_mm)
    EXPECT_LT(nearest_on_profile(tool.profile, std::hypot(v.x(), v.y()), v.z()).signed_distance_mm, 0.008);
}

TEST(MeshTool, AsksForTheAxisWhereThereIsNone) {
  const test::TemporaryFolder folder;
  const auto ball_path = folder.path() / "ball.ply", box_path = folder.path() / "box.ply";
  ToolProfile ball;
  for (int i = 0; i <= 64; ++i) {
    const double angle = 3.14159265358979 * i / 64.0;
    ball.points.push_back({i == 64 ? 0.0 : 10.0 * std::sin(angle), 10.0 * std::cos(angle)});
    if (i > 0) ball.roles.push_back(SurfaceRole::cutting);
  }
  write_ply(ball_path, revolve(ball, 128));
  write_ply(box_path, test::box_mesh({3.0f, 4.0f, 5.0f}));
  test::expect_error(ErrorKind::invalid_input, "--tool-axis", [&] { make_tool(ball_path.string()); });
  test::expect_error(ErrorKind::invalid_input, "--tool-axis", [&] { make_tool(box_path.string()); });

  const Tool tool = make_tool(ball_path.string(), ToolAxis{Vec3::Zero(), -Vec3::UnitZ()});
  EXPECT_NEAR(tool.tool_from_mesh.inverse().translation_mm.z(), -10.0, 0.01);
  EXPECT_NEAR(front_z_mm(tool.profile, 6.0), -2.0, 0.02);
  const auto bunny = test::shared_data("mesh/bunny_16301.ply");
  REAM_SKIP_WITHOUT(bunny);
  test::expect_error(ErrorKind::invalid_input, "--tool-axis", [&] { make_tool(bunny.string()); });
}

TEST(MeshTool, RefusesAnAxisThatMissesTheMesh) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "box.ply";
  write_ply(path, test::box_mesh({3.0f, 4.0f, 5.0f}));
  test::expect_error(ErrorKind::invalid_input, "axis", [&] {
    make_tool(path.string(), ToolAxis{Vec3(50, 0, 0), Vec3::UnitZ()});
  });
  test::expect_error(ErrorKind::usage, "axis", [&] {
    make_tool(path.string(), ToolAxis{Vec3::Zero(), Vec3::Zero()});
  });
  test::expect_error(ErrorKind::usage, "axis", [&] {
    make_tool(path.string(), ToolAxis{Vec3(NAN, 0, 0), Vec3::UnitZ()});
  });
}

TEST(MeshTool, AnOpenCapIsGivenABack) {
  ToolProfile cap = make_tool("sphere 20").profile;
  while (cap.roles.back() != SurfaceRole::cutting) {
    cap.roles.pop_back();
    cap.points.pop_back();
  }
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "cap.ply";
  write_ply(path, revolve(cap, 128));
  const Tool tool = make_tool(path.string(), ToolAxis{Vec3::Zero(), Vec3::UnitZ()});
  EXPECT_NEAR(tool.profile.min_z_mm(), cap.min_z_mm() - 1.0, 0.01);
  EXPECT_NEAR(front_z_mm(tool.profile, 10.0), std::sqrt(300.0) - 20.0, 0.01);
  EXPECT_GT(revolve(tool.profile, 64).volume_mm3(), 100.0);
}

}  // namespace
}  // namespace ream::shell
