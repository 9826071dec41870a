#include "case/measures.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

#include "support/expect_error.hpp"
#include "support/seed.hpp"
#include "support/shoulder_landmarks.hpp"

namespace ream::case_ {
namespace {

constexpr double tiny_deg = 1e-9;

double degrees(const std::optional<double>& rad) { return degrees_from_radians(rad.value()); }

std::vector<test::ShoulderShape> seeded_shapes(unsigned seed, int count) {
  std::mt19937_64 random(seed);
  const auto between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  std::vector<test::ShoulderShape> shapes;
  for (int i = 0; i < count; ++i)
    shapes.push_back({i % 2 ? Side::left : Side::right, between(-25, 15), between(-10, 20), between(15, 50),
                      between(30, 44), between(20, 32), between(-8, 8)});
  return shapes;
}

/// Calls visit with every point.
template <typename Visit>
void each_point(Landmarks& l, Visit&& visit) {
  for (auto* p : {&l.glenoid_centre_mm, &l.superior_rim_mm, &l.inferior_rim_mm, &l.anterior_rim_mm,
                  &l.posterior_rim_mm, &l.trigonum_mm, &l.inferior_angle_mm})
    if (*p) visit(**p);
  if (l.humeral_head) visit(l.humeral_head->centre_mm);
  for (Vec3& p : l.biconcavity_mm) visit(p);
}

void expect_same(const Measures& a, const Measures& b, double tolerance_deg, bool friedman_too) {
  const auto near = [&](const std::optional<double>& p, const std::optional<double>& q) {
    EXPECT_NEAR(degrees(p), degrees(q), tolerance_deg);
  };
  near(a.version_3d_rad, b.version_3d_rad);
  near(a.inclination_3d_rad, b.inclination_3d_rad);
  EXPECT_NEAR(*a.subluxation_percent, *b.subluxation_percent, 1e-9);
  EXPECT_NEAR(*a.subluxation_glenoid_percent, *b.subluxation_glenoid_percent, 1e-9);
  if (!friedman_too) return;
  near(a.version_friedman_rad, b.version_friedman_rad);
  near(a.inclination_friedman_rad, b.inclination_friedman_rad);
}

TEST(Measures, AnglesIn3dAreThoseOfTheFace) {
  const uint32_t seed = test::seed(20071);
  SCOPED_TRACE("random seed " + std::to_string(seed));
  for (const auto& shape : seeded_shapes(seed, 50)) {
    const Measures m = measure(test::shoulder_landmarks(shape), shape.side);
    EXPECT_NEAR(degrees(m.version_3d_rad), shape.version_deg, tiny_deg);
    EXPECT_NEAR(degrees(m.inclination_3d_rad), shape.inclination_deg, tiny_deg);
    EXPECT_TRUE(m.missing.empty());
  }
}

/// Friedman's angles once more, by sines of the rim lines over the axis instead of angles at a corner.
TEST(Measures, FriedmanAgreesWithAnotherComputationInItsPlanes) {
  const uint32_t seed = test::seed(20072);
  SCOPED_TRACE("random seed " + std::to_string(seed));
  using Vec2 = Eigen::Vector2d;
  const auto tilt = [](const Vec2& line, const Vec2& axis) {
    return degrees_from_radians(-std::asin(line.normalized().dot(axis.normalized())));
  };
  for (const auto& shape : seeded_shapes(seed, 50)) {
    const Landmarks l = test::shoulder_landmarks(shape);
    const Measures m = measure(l, shape.side);
    const Vec2 trigonum = l.trigonum_mm->head<2>(), front = l.anterior_rim_mm->head<2>(),
               back = l.posterior_rim_mm->head<2>();
    EXPECT_NEAR(degrees(m.version_friedman_rad), tilt(front - back, 0.5 * (front + back) - trigonum),
                tiny_deg);
    const Vec3 axis = 0.5 * (*l.superior_rim_mm + *l.inferior_rim_mm) - *l.trigonum_mm;
    const Vec2 along = axis.head<2>().normalized();
    const auto coronal = [&](const Vec3& v) { return Vec2(along.dot(v.head<2>()), v.z()); };
    EXPECT_NEAR(degrees(m.inclination_friedman_rad),
                tilt(coronal(*l.superior_rim_mm - *l.inferior_rim_mm), coronal(axis)), tiny_deg);
  }
}

TEST(Measures, FriedmanIsThe3dAngleWhereTheOtherOneIsZero) {
  for (const double degrees_in : {-20.0, -3.0, 0.0, 11.0}) {
    const Measures version =
        measure(test::shoulder_landmarks({.version_deg = degrees_in, .inclination_deg = 0}), Side::right);
    EXPECT_NEAR(degrees(version.version_friedman_rad), degrees_in, tiny_deg);
    const Measures inclination =
        measure(test::shoulder_landmarks({.version_deg = 0, .inclination_deg = degrees_in}), Side::right);
    EXPECT_NEAR(degrees(inclination.inclination_friedman_rad), degrees_in, tiny_deg);
  }
}

TEST(Measures, AMirroredShoulderHasExactlyTheSameFigures) {
  const uint32_t seed = test::seed(20073);
  SCOPED_TRACE("random seed " + std::to_string(seed));
  for (auto shape : seeded_shapes(seed, 50)) {
    shape.side = Side::right;
    Landmarks l = test::shoulder_landmarks(shape);
    l.biconcavity_mm = {*l.anterior_rim_mm, *l.glenoid_centre_mm - Vec3(0.5, 2, 0), *l.posterior_rim_mm};
    const auto right = to_json(measure(l, Side::right));
    each_point(l, [](Vec3& p) { p.x() = -p.x(); });
    EXPECT_EQ(to_json(measure(l, Side::left)).dump(), right.dump());
    EXPECT_FALSE(right.at("biconcavity").is_null());
  }
}

TEST(Measures, WhatMovingTurningAndScalingLeaveAlone) {
  const uint32_t seed = test::seed(20074);
  SCOPED_TRACE("random seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  const auto unit = [&] { return static_cast<double>(random() >> 11) * 0x1p-52 - 1.0; };
  for (const auto& shape : seeded_shapes(seed, 50)) {
    const Landmarks l = test::shoulder_landmarks(shape);
    const Measures before = measure(l, shape.side);
    Landmarks moved = l;
    const Vec3 by(300 * unit(), 300 * unit(), 300 * unit());
    each_point(moved, [&](Vec3& p) { p += by; });
    expect_same(measure(moved, shape.side), before, 1e-8, true);
    Landmarks about_z = l, about_any = l, scaled = l;
    const Mat3 upright(Eigen::AngleAxisd(0.6 * unit(), Vec3::UnitZ()));
    const Mat3 tilted(Eigen::AngleAxisd(0.5 * unit(), Vec3(unit(), unit(), unit()).normalized()));
    each_point(about_z, [&](Vec3& p) { p = upright * p; });
    each_point(about_any, [&](Vec3& p) { p = tilted * p; });
    each_point(scaled, [&](Vec3& p) { p *= 1.3; });
    scaled.humeral_head->radius_mm *= 1.3;
    expect_same(measure(about_z, shape.side), before, 1e-8, true);
    expect_same(measure(about_any, shape.side), before, 1e-8, false);
    expect_same(measure(scaled, shape.side), before, 1e-8, true);
  }
}

TEST(Measures, SubluxationAgainstThePlaneOfTheScapulaAndAgainstTheFace) {
  test::ShoulderShape shape{.version_deg = 0.0, .inclination_deg = 0.0, .head_posterior_mm = 0.0};
  Measures m = measure(test::shoulder_landmarks(shape), Side::right);
  EXPECT_NEAR(*m.subluxation_percent, 50.0, 1e-9);
  EXPECT_NEAR(*m.subluxation_glenoid_percent, 50.0, 1e-9);
  shape.head_posterior_mm = 12.0;  // half of its radius
  m = measure(test::shoulder_landmarks(shape), Side::right);
  EXPECT_NEAR(*m.subluxation_percent, 75.0, 1e-9);
  EXPECT_NEAR(*m.subluxation_glenoid_percent, 75.0, 1e-9);
  shape = {.version_deg = -20.0, .inclination_deg = 0.0};
  m = measure(test::shoulder_landmarks(shape), Side::right);
  EXPECT_NEAR(*m.subluxation_percent, 50.0 + 50.0 * 27.0 * std::sin(radians_from_degrees(20.0)) / 24.0, 1e-9);
  EXPECT_NEAR(*m.subluxation_glenoid_percent, 50.0, 1e-9) << "centred on its face";
  shape.head_posterior_mm = 300.0;
  EXPECT_EQ(*measure(test::shoulder_landmarks(shape), Side::right).subluxation_percent, 100.0);
}

TEST(Measures, ABiconcaveGlenoidIsMeasuredByItsIntermediateLine) {
  Landmarks l = test::shoulder_landmarks({.version_deg = 0.0, .inclination_deg = 0.0, .plane_deg = 0.0});
  // In a scapula that lies in the coronal plane, lateral is -x and posterior +y: the ridge at the middle, the
  // front edge straight before it, the back edge 20 degrees medial of straight behind it.
  const Vec3 ridge = *l.glenoid_centre_mm;
  const double turned = radians_from_degrees(20.0);
  l.biconcavity_mm = {ridge - Vec3(0, 12, 0), ridge,
                      ridge + 12.0 * Vec3(std::sin(turned), std::cos(turned), 0)};
  const Measures m = measure(l, Side::right);
  ASSERT_TRUE(m.biconcavity);
  EXPECT_NEAR(degrees(m.biconcavity->paleo_version_rad), 0.0, tiny_deg);
  EXPECT_NEAR(degrees(m.biconcavity->neo_version_rad), -20.0, tiny_deg);
  EXPECT_NEAR(degrees(m.biconcavity->between_rad), 20.0, tiny_deg);
  EXPECT_NEAR(degrees(m.biconcavity->intermediate_version_rad), -10.0, tiny_deg);
  EXPECT_EQ(m.version_3d_rad, m.biconcavity->intermediate_version_rad);
  EXPECT_NEAR(degrees(m.version_friedman_rad), -10.0, 0.7) << "its axis ends at the middle of the line";
  l.anterior_rim_mm.reset();
  l.posterior_rim_mm.reset();
  EXPECT_EQ(measure(l, Side::right).version_3d_rad, m.version_3d_rad);
  EXPECT_TRUE(measure(l, Side::right).missing.empty());
}

TEST(Measures, WhatIsMissingIsNamedAndTheRestMeasured) {
  const Landmarks all = test::shoulder_landmarks({});
  Landmarks l = all;
  l.inferior_angle_mm.reset();
  Measures m = measure(l, Side::right);
  EXPECT_EQ(m.missing, std::vector<std::string>{"inferior_angle_mm"});
  EXPECT_FALSE(m.version_3d_rad || m.inclination_3d_rad || m.subluxation_percent);
  EXPECT_TRUE(m.version_friedman_rad && m.inclination_friedman_rad && m.subluxation_glenoid_percent);
  l = all;
  l.humeral_head.reset();
  m = measure(l, Side::right);
  EXPECT_EQ(m.missing, std::vector<std::string>{"humeral_head"});
  EXPECT_TRUE(m.version_3d_rad && m.version_friedman_rad);
  const auto value = to_json(measure({}, Side::left));
  EXPECT_EQ(value.at("missing").size(), 8u);
  for (const char* key :
       {"version_3d_deg", "inclination_3d_deg", "version_friedman_deg", "inclination_trigonum_deg",
        "inclination_friedman_deg", "subluxation_percent", "biconcavity"})
    EXPECT_TRUE(value.at(key).is_null()) << key;
  EXPECT_EQ(value.at("normal").at("version_deg").at("mean"), -1.23);
  test::expect_error(ErrorKind::invalid_input, "trigonum_mm", [] {
    landmarks_from_json({{"trigonum_mm", {1, 2}}}, "l");
  });
  test::expect_error(ErrorKind::invalid_input, "posterior_rim_mm", [&] {
    Landmarks fewer = all;
    fewer.posterior_rim_mm.reset();
    glenoid_frame(fewer, Side::right);
  });
}

TEST(Measures, ContradictionsAreRefusedInOneLine) {
  const auto refuse = [](const char* mentioned, Side side, const std::function<void(Landmarks&)>& change) {
    Landmarks l = test::shoulder_landmarks({});
    change(l);
    test::expect_error(ErrorKind::invalid_input, mentioned, [&] { measure(l, side); });
  };
  refuse("one line", Side::right, [](auto& l) {
    l.inferior_angle_mm = *l.glenoid_centre_mm + 2.0 * (*l.trigonum_mm - *l.glenoid_centre_mm);
  });
  refuse("same point", Side::right, [](auto& l) { l.trigonum_mm = l.glenoid_centre_mm; });
  refuse("same point", Side::right, [](auto& l) { l.anterior_rim_mm = l.posterior_rim_mm; });
  refuse("one line", Side::right, [](auto& l) {
    l.anterior_rim_mm = l.superior_rim_mm;
    l.posterior_rim_mm = l.inferior_rim_mm;
  });
  refuse("swapped", Side::right, [](auto& l) { std::swap(l.anterior_rim_mm, l.posterior_rim_mm); });
  refuse("swapped", Side::right, [](auto& l) { std::swap(l.superior_rim_mm, l.inferior_rim_mm); });
  refuse("other shoulder", Side::left, [](auto&) {});
  refuse("above or below", Side::right, [](auto& l) {
    l.trigonum_mm = 0.5 * (*l.superior_rim_mm + *l.inferior_rim_mm) + Vec3(0, 0, 50);
    l.anterior_rim_mm.reset();
    l.inferior_angle_mm.reset();
  });
  Landmarks nan = test::shoulder_landmarks({});
  nan.superior_rim_mm->x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(measure(nan, Side::right), Error);
}

TEST(Measures, WordsNeverHaveABareSign) {
  EXPECT_EQ(version_in_words(radians_from_degrees(-12.0)), "12.0\u00b0 retroversion");
  EXPECT_EQ(version_in_words(radians_from_degrees(3.04)), "3.0\u00b0 anteversion");
  EXPECT_EQ(version_in_words(radians_from_degrees(-0.04)), "0.0\u00b0 version");
  EXPECT_EQ(inclination_in_words(radians_from_degrees(4.0)), "4.0\u00b0 superior");
  EXPECT_EQ(inclination_in_words(radians_from_degrees(-7.25)), "7.3\u00b0 inferior");
  EXPECT_EQ(inclination_in_words(0.0), "0.0\u00b0 inclination");
}

TEST(GlenoidFrame, IsThatOfTheFaceOnEitherSide) {
  for (const Side side : {Side::right, Side::left}) {
    const Landmarks l = test::shoulder_landmarks({.side = side, .version_deg = -12, .inclination_deg = 7});
    const GlenoidFrame frame = glenoid_frame(l, side);
    EXPECT_EQ(frame.centre_mm, *l.glenoid_centre_mm);
    const FaceAngles angles =
        face_angles(frame.lateral, *l.glenoid_centre_mm, *l.trigonum_mm, *l.inferior_angle_mm);
    EXPECT_NEAR(degrees_from_radians(angles.version_rad), -12.0, tiny_deg);
    EXPECT_NEAR(degrees_from_radians(angles.inclination_rad), 7.0, tiny_deg);
    EXPECT_GT(frame.superior.z(), 0.9);
    EXPECT_LT(frame.anterior.y(), -0.5);
    Mat3 axes;
    axes << frame.lateral, frame.superior, frame.anterior;
    EXPECT_LT((axes.transpose() * axes - Mat3::Identity()).norm(), 1e-12);
    Landmarks far = l;
    far.trigonum_mm.reset();
    EXPECT_EQ(glenoid_frame(far, side).lateral, frame.lateral) << "by the side alone";
  }
}

TEST(ScapularFrame, NormalAndAnglesAreInverse) {
  const Landmarks l = test::shoulder_landmarks({});
  const ScapularFrame frame = scapular_frame(*l.glenoid_centre_mm, *l.trigonum_mm, *l.inferior_angle_mm);
  for (const double version : {-0.5, -0.1, 0.0, 0.3})
    for (const double inclination : {-0.4, 0.0, 0.2}) {
      const FaceAngles back = frame.angles_of(frame.face_normal({version, inclination}));
      EXPECT_NEAR(back.version_rad, version, 1e-14);
      EXPECT_NEAR(back.inclination_rad, inclination, 1e-14);
    }
}

}  // namespace
}  // namespace ream::case_
