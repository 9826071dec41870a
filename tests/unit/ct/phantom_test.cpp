#include "ct/phantom/phantom.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>

#include "case/measures.hpp"
#include "core/units.hpp"
#include "ct/build/bone_from_mask.hpp"
#include "ct/phantom/phantom_case.hpp"
#include "support/expect_error.hpp"

namespace ream::ct {
namespace {

struct Sphere {
  Vec3 centre;
  double radius;
};

Sphere fitted(const std::vector<Vec3>& points) {
  Eigen::MatrixXd a(static_cast<Eigen::Index>(points.size()), 4);
  Eigen::VectorXd b(a.rows());
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    const Vec3& p = points[static_cast<size_t>(i)];
    a.row(i) << 2 * p.transpose(), 1.0;
    b[i] = p.squaredNorm();
  }
  const Eigen::Vector4d x = a.colPivHouseholderQr().solve(b);
  return {x.head<3>(), std::sqrt(x[3] + x.head<3>().squaredNorm())};
}

/// Surface points met by parallel rays along the scapular axis (known from landmarks, not from the face).
std::vector<Vec3> surface_points(const case_::Case& c, const GroundTruth& truth) {
  const Vec3 medial = (truth.spine_root_mm - truth.glenoid.centre_mm).normalized();
  const Vec3 across = medial.cross(Vec3::UnitZ()).normalized();
  std::vector<Vec3> points;
  for (double s = -22.0; s <= 22.0; s += 0.5)
    for (double t = -16.0; t <= 16.0; t += 0.5) {
      const Vec3 through = truth.glenoid.centre_mm + s * Vec3::UnitZ() + t * across;
      if (const auto hit = case_::surface_along(c.bone, through, medial)) points.push_back(*hit);
    }
  return points;
}

/// Mean of the hundredth of the points that lie furthest along `direction`.
Vec3 extreme(std::vector<Vec3> points, const Vec3& direction) {
  const size_t count = std::max<size_t>(1, points.size() / 100);
  std::sort(points.begin(), points.end(),
            [&](const Vec3& a, const Vec3& b) { return a.dot(direction) > b.dot(direction); });
  Vec3 sum = Vec3::Zero();
  for (size_t i = 0; i < count; ++i) sum += points[i];
  return sum / static_cast<double>(count);
}

struct Anatomy {
  double version_deg, inclination_deg, radius_mm;
  case_::Side side;
};

class MeasuredBack : public testing::TestWithParam<Anatomy> {};

TEST_P(MeasuredBack, RadiusCentreVersionAndInclination) {
  PhantomPreset preset = phantom_preset("demo");
  preset.params.version_rad = radians_from_degrees(GetParam().version_deg);
  preset.params.inclination_rad = radians_from_degrees(GetParam().inclination_deg);
  preset.params.glenoid_radius_mm = GetParam().radius_mm;
  preset.params.side = GetParam().side;
  preset.params.field_mm = {{-12.0, -20.0, -24.0}, {26.4, 24.0, 24.0}};
  const GroundTruth truth = make_phantom(preset.params).truth;
  const case_::Case c = make_phantom_case("phantom", preset.params, preset.upsample);
  const auto points = surface_points(c, truth);

  std::vector<Vec3> face;
  for (const Vec3& p : points)
    if ((p - truth.glenoid.centre_mm).norm() < 9.0) face.push_back(p);
  ASSERT_GT(face.size(), 500u);
  const Sphere sphere = fitted(face);
  EXPECT_NEAR(sphere.radius, truth.articular_radius_mm, 0.5);
  EXPECT_LT((sphere.centre - truth.articular_sphere_centre_mm).norm(), 0.5);
  double worst = 0;
  for (const Vec3& p : face)
    worst =
        std::max(worst, std::abs((p - truth.articular_sphere_centre_mm).norm() - truth.articular_radius_mm));
  EXPECT_LT(worst, 0.1);

  std::vector<Vec3> articular;
  for (const Vec3& p : points)
    if (std::abs((p - sphere.centre).norm() - sphere.radius) < 0.25) articular.push_back(p);
  const Vec3 posterior = -truth.glenoid.anterior;
  const Vec3 poles = extreme(articular, Vec3::UnitZ()) - extreme(articular, -Vec3::UnitZ());
  const Vec3 sides = extreme(articular, posterior) - extreme(articular, -posterior);
  // The rim is rounded, so the articular surface ends a little before the outline.
  EXPECT_NEAR(poles.norm(), truth.glenoid_height_mm, 3.0);
  EXPECT_NEAR(sides.norm(), truth.glenoid_width_mm, 2.0);
  Vec3 normal = poles.cross(sides).normalized();
  if (normal.dot(truth.glenoid.lateral) < 0) normal = -normal;
  const case_::FaceAngles angles =
      case_::face_angles(normal, truth.glenoid.centre_mm, truth.spine_root_mm, truth.inferior_angle_mm);
  EXPECT_NEAR(degrees_from_radians(angles.version_rad), GetParam().version_deg, 1.5);
  EXPECT_NEAR(degrees_from_radians(angles.inclination_rad), GetParam().inclination_deg, 1.5);
}

INSTANTIATE_TEST_SUITE_P(Anatomies, MeasuredBack,
                         testing::Values(Anatomy{-2.0, 4.2, 35.0, case_::Side::right},
                                         Anatomy{-15.0, 0.0, 32.0, case_::Side::right},
                                         Anatomy{6.0, -7.0, 40.0, case_::Side::left},
                                         Anatomy{-15.0, 8.0, 35.0, case_::Side::left}));

TEST(Phantom, TruthAgreesWithTheDefinitionOfItsAngles) {
  for (const case_::Side side : {case_::Side::right, case_::Side::left}) {
    PhantomParams params = phantom_preset("demo").params;
    params.side = side;
    params.spacing_mm = Vec3::Constant(4.0);
    params.version_rad = radians_from_degrees(-12.0);
    params.inclination_rad = radians_from_degrees(5.0);
    const GroundTruth t = make_phantom(params).truth;
    const case_::FaceAngles angles =
        case_::face_angles(t.glenoid.lateral, t.glenoid.centre_mm, t.spine_root_mm, t.inferior_angle_mm);
    EXPECT_NEAR(angles.version_rad, params.version_rad, 1e-9);
    EXPECT_NEAR(angles.inclination_rad, params.inclination_rad, 1e-9);
    // Retroverted: the face looks more posterior (LPS +y) than the scapular axis does.
    const Vec3 axis = (t.glenoid.centre_mm - t.spine_root_mm).normalized();
    EXPECT_GT(t.glenoid.lateral.y(), axis.y());
    EXPECT_LT(t.glenoid.anterior.y(), 0.0);
    EXPECT_GT(t.glenoid.superior.z(), 0.0);
  }
}

TEST(Phantom, SidesAreMirrorImages) {
  PhantomPreset preset = phantom_preset("demo");
  preset.params.spacing_mm = Vec3::Constant(0.8);
  const Phantom right = make_phantom(preset.params);
  const case_::Case right_case = make_phantom_case("right", preset.params, 2);
  preset.params.side = case_::Side::left;
  const Phantom left = make_phantom(preset.params);
  const case_::Case left_case = make_phantom_case("left", preset.params, 2);
  const auto& volume = right.volume;
  for (int w = 0; w < volume.dims.z(); ++w)
    for (int v = 0; v < volume.dims.y(); ++v)
      for (int u = 0; u < volume.dims.x(); ++u) {
        const int other = volume.dims.x() - 1 - u;
        ASSERT_EQ(volume.hu[volume.index(u, v, w)], left.volume.hu[volume.index(other, v, w)]);
        const Vec3 p = volume.world_of_centre({u, v, w}), q = left.volume.world_of_centre({other, v, w});
        ASSERT_LT((Vec3(-p.x(), p.y(), p.z()) - q).norm(), 1e-9);
      }
  EXPECT_EQ(right.truth.spine_root_mm.x(), -left.truth.spine_root_mm.x());
  EXPECT_EQ(right_case.bone.filled_voxels(), left_case.bone.filled_voxels());
  EXPECT_EQ(left_case.side, case_::Side::left);
}

TEST(Phantom, SeedDecidesTheNoiseAndNothingElse) {
  PhantomParams params = phantom_preset("demo").params;
  params.spacing_mm = Vec3::Constant(1.0);
  const auto first = make_phantom(params).volume.hu;
  EXPECT_EQ(first, make_phantom(params).volume.hu);
  params.random_seed = 2;
  const auto second = make_phantom(params).volume.hu;
  EXPECT_NE(first, second);
  double sum = 0, squares = 0;
  for (size_t i = 0; i < first.size(); ++i) {
    const double d = first[i] - second[i];
    sum += d;
    squares += d * d;
  }
  const auto n = static_cast<double>(first.size());
  EXPECT_NEAR(sum / n, 0.0, 0.5);
  EXPECT_NEAR(std::sqrt(squares / n / 2.0), params.noise_hu, 0.5);
}

TEST(Phantom, DensitiesAreThoseOfBone) {
  const PhantomPreset preset = phantom_preset("demo");
  const case_::Case c = make_phantom_case("demo", preset.params, preset.upsample);
  const auto density_at = [&](double depth_mm) {
    const Vec3 p =
        c.bone.grid.world_from_grid.inverse().point(c.plan->entry_mm + depth_mm * c.plan->axis_direction);
    return voxel::density_g_cc(c.bone.density[c.bone.grid.index(c.bone.grid.voxel_at(p))]);
  };
  for (const double depth : {0.2, 0.8, 1.4}) EXPECT_NEAR(density_at(depth), 1.5, 0.1) << depth;
  for (const double depth : {2.8, 5.0, 8.0}) {
    EXPECT_GT(density_at(depth), 0.35) << depth;
    EXPECT_LT(density_at(depth), 0.75) << depth;
  }
}

TEST(Phantom, ThesisCaseHasItsSizeAndFill) {
  const PhantomPreset preset = phantom_preset("thesis-5-4-2");
  const case_::Case c = make_phantom_case("thesis-5-4-2", preset.params, preset.upsample);
  EXPECT_EQ(c.bone.grid.dims, Vec3i(600, 384, 464));
  EXPECT_NEAR(static_cast<double>(c.bone.filled_voxels()), 12.7e6, 0.127e6);
  EXPECT_NEAR(c.bone.grid.spacing_mm.x(), 0.0835, 1e-12);
}

TEST(Phantom, RefusesImpossibleParameters) {
  PhantomParams params;
  params.version_rad = 2.0;
  test::expect_error(ErrorKind::invalid_input, "version", [&] { make_phantom(params); });
  params = {};
  params.glenoid_radius_mm = std::nan("");
  test::expect_error(ErrorKind::invalid_input, "radius", [&] { make_phantom(params); });
  params = {};
  params.spacing_mm = Vec3::Constant(0.06);
  test::expect_error(ErrorKind::invalid_input, "larger voxel size", [&] { make_phantom(params); });
  params = {};
  params.field_mm = {Vec3::Zero(), Vec3::Zero()};
  test::expect_error(ErrorKind::invalid_input, "no voxels", [&] { make_phantom(params); });
  test::expect_error(ErrorKind::not_found, "nothing", [] { phantom_preset("nothing"); });
}

TEST(Calibration, ChainAndItsInverse) {
  const case_::Calibration calibration;
  // Worked example of the reference: 1739 HU is 1.90 g/cc.
  EXPECT_NEAR(apparent_density_g_cc(1739, calibration), 1.90, 0.01);
  for (const double density : {0.3, 0.7, 1.5, 2.0})
    EXPECT_NEAR(apparent_density_g_cc(hu_of_apparent_density(density, calibration), calibration), density,
                1e-12);
  EXPECT_EQ(apparent_density_g_cc(-1000, calibration), 0.0);
}

}  // namespace
}  // namespace ream::ct
