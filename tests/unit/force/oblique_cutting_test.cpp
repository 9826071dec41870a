#include "force/oblique_cutting.hpp"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <cmath>

#include "unit/force/thesis_lip.hpp"

namespace ream::force {
namespace {

using test::ellipse_a_mm;
using test::ellipse_b_mm;
using test::ellipse_element;
using test::thesis_lip;
using test::thesis_offset_mm;

/// An element's cutting geometry from explicit vectors instead of angles: x outwards, y with the rotation, z
/// out of the bone.
struct VectorReference {
  Vec3 edge, velocity, out_of_cut, across_rake;

  VectorReference(double radius_mm, double offset_mm, double rise, double feed_mm) {
    const double along_mm = std::sqrt(radius_mm * radius_mm - offset_mm * offset_mm);
    // Seen along the axis the lip is a line that passes it at the offset and trails outwards.
    edge = Vec3(along_mm / radius_mm, -offset_mm / radius_mm, rise).normalized();
    velocity = Vec3(0.0, 2.0 * pi * radius_mm, -feed_mm).normalized();
    out_of_cut = -velocity.cross(edge).normalized();
    if (out_of_cut.z() < 0.0) out_of_cut = -out_of_cut;
    // No rake: the rake face holds the edge and the way out of the cut. Bone pushes against the motion.
    across_rake = edge.cross(out_of_cut).normalized();
    if (across_rake.dot(velocity) > 0.0) across_rake = -across_rake;
  }
  double sin_inclination() const { return -edge.dot(velocity); }
  double cos_inclination() const { return edge.cross(velocity).norm(); }
  /// Stabler: chips leave at the inclination from the edge's normal, and drag the lip along.
  Vec3 chip_drag() const { return cos_inclination() * out_of_cut + sin_inclination() * edge; }
};

double rise_of_ellipse(double radius_mm) {
  return ellipse_b_mm * radius_mm /
         (ellipse_a_mm * std::sqrt((ellipse_a_mm - radius_mm) * (ellipse_a_mm + radius_mm)));
}

constexpr double radii_mm[] = {3.05, 3.2, 4.0, 6.0, 10.0, 14.0, 17.0, 18.0, 18.24};
constexpr double feeds_mm[] = {1e-4, 0.01, 0.09, 0.5, 2.0};

TEST(ObliqueCutting, LipPassesTheAxisAtThreeMillimetres) { EXPECT_NEAR(thesis_offset_mm(), 3.0, 5e-4); }

TEST(ObliqueCutting, FiveRadiiByHand) {
  // From the vectors above with 40 digits (mpmath): feed 0.09 mm a revolution, friction 0.5. Thrust is per
  // chip area and specific coefficient, torque likewise.
  struct {
    double radius_mm, sin_inclination, depth_mm, thrust, torque_mm;
  } const by_hand[] = {{3.2, 0.934147511535, 0.017502484222, -0.00209486117543, 2.5383047829},
                       {6.0, 0.493119815859, 0.0176610370424, 0.375344094976, 5.94391043712},
                       {10.0, 0.285872416135, 0.0170513677871, 0.407613275011, 9.98546369039},
                       {14.0, 0.185072098775, 0.0154108893529, 0.373067939655, 13.9925745294},
                       {18.0, 0.0542735789139, 0.00570860027259, 0.133360447749, 17.9980759003}};
  for (const auto& hand : by_hand) {
    const LipElement element = ellipse_element(hand.radius_mm, 0.1);
    const CuttingAngles angles = cutting_angles(element, thesis_offset_mm(), 0.09);
    const ElementLoad load = element_load(element, thesis_offset_mm(), {}, {0.09});
    EXPECT_NEAR(angles.sin_inclination, hand.sin_inclination, 1e-11) << "radius " << hand.radius_mm;
    EXPECT_NEAR(load.depth_of_cut_mm, hand.depth_mm, 1e-11) << "radius " << hand.radius_mm;
    EXPECT_NEAR(load.thrust_n / load.chip_mm2, hand.thrust, 1e-10) << "radius " << hand.radius_mm;
    EXPECT_NEAR(load.torque_n_mm / load.chip_mm2, hand.torque_mm, 1e-9) << "radius " << hand.radius_mm;
  }
}

TEST(ObliqueCutting, AnglesAreThoseOfTheVectors) {
  for (const double radius_mm : radii_mm)
    for (const double feed_mm : feeds_mm) {
      const VectorReference v(radius_mm, thesis_offset_mm(), rise_of_ellipse(radius_mm), feed_mm);
      const CuttingAngles a = cutting_angles(ellipse_element(radius_mm, 0.1), thesis_offset_mm(), feed_mm);
      const auto where = testing::Message() << "radius " << radius_mm << " feed " << feed_mm;
      EXPECT_NEAR(a.sin_inclination, v.sin_inclination(), 1e-13) << where;
      EXPECT_NEAR(a.cos_inclination, v.cos_inclination(), 1e-13) << where;
      const Mat3 r = machining_from_cutting(a);
      EXPECT_NEAR((r.col(1) - v.velocity).norm(), 0.0, 1e-13) << where;
      EXPECT_NEAR((r.col(2) - v.out_of_cut).norm(), 0.0, 1e-12) << where;
      const Vec3 edge = a.cos_inclination * r.col(0) - a.sin_inclination * r.col(1);
      EXPECT_NEAR((edge - v.edge).norm(), 0.0, 1e-12) << where;
      const RakeDirections forces = cutting_from_rake(a, 0.0);
      EXPECT_NEAR((r * forces.col(0) - v.across_rake).norm(), 0.0, 1e-12) << where;
      EXPECT_NEAR((r * forces.col(1) - v.chip_drag()).norm(), 0.0, 1e-12) << where;
    }
}

TEST(ObliqueCutting, ThrustAndTorqueAreTheVectors) {
  const CuttingCoefficients coefficients{0.37, 0.0, 0.0, 0.0, 0.0};
  for (const double radius_mm : radii_mm)
    for (const double feed_mm : feeds_mm) {
      const VectorReference v(radius_mm, thesis_offset_mm(), rise_of_ellipse(radius_mm), feed_mm);
      const ElementLoad load = element_load(ellipse_element(radius_mm, 0.1), thesis_offset_mm(), coefficients,
                                            {feed_mm, reference_spindle_rad_s, 25.0});
      // Length of edge, seen across its velocity, times feed of a lip, seen out of the cut.
      const double length_mm = 0.1 / v.edge.x();
      const double width_mm = length_mm * v.cos_inclination();
      const double depth_mm = feed_mm / 5.0 * v.out_of_cut.z();
      const double chip_mm2 = width_mm * depth_mm;
      const Vec3 force_n = 25.0 * chip_mm2 * (v.across_rake + 0.37 * v.chip_drag());
      const double tolerance = 1e-11 * 25.0 * chip_mm2 * radius_mm;
      const auto where = testing::Message() << "radius " << radius_mm << " feed " << feed_mm;
      EXPECT_NEAR(load.chip_mm2, chip_mm2, 1e-11 * chip_mm2) << where;
      EXPECT_NEAR(load.depth_of_cut_mm, depth_mm, 1e-11 * depth_mm) << where;
      EXPECT_NEAR(load.thrust_n, force_n.z(), tolerance) << where;
      EXPECT_NEAR(load.torque_n_mm, -radius_mm * force_n.y(), tolerance) << where;
    }
}

TEST(ObliqueCutting, AgreesWithTheCorrectedA16AndA17) {
  for (const double radius_mm : radii_mm) {
    const double feed_mm = 0.2;
    const LipElement element = ellipse_element(radius_mm, 0.1);
    const CuttingAngles a = cutting_angles(element, thesis_offset_mm(), feed_mm);
    const ElementLoad load = element_load(element, thesis_offset_mm(), {}, {feed_mm});
    const double dfn = load.chip_mm2, dft = 0.5 * dfn;
    const double sin_l = a.sin_inclination, cos_l = a.cos_inclination;
    const double thrust = (-a.sin_tau * a.cos_cutting * sin_l + a.sin_cutting * cos_l) * dfn +
                          (a.sin_tau * a.cos_cutting * sin_l * cos_l + a.sin_cutting * sin_l * sin_l +
                           a.cos_tau * a.cos_cutting * cos_l) *
                              dft;
    EXPECT_NEAR(load.thrust_n, thrust, 1e-14) << "radius " << radius_mm;
    // A.17 turns y' into torque where its own text says y: the two part by the cutting angle.
    const double torque = radius_mm * (cos_l * dfn + sin_l * sin_l * dft);
    EXPECT_NEAR(load.torque_n_mm, torque, a.sin_cutting * radius_mm * (dfn + dft)) << "radius " << radius_mm;
    const ElementLoad slow = element_load(element, thesis_offset_mm(), {}, {1e-9});
    const CuttingAngles b = cutting_angles(element, thesis_offset_mm(), 1e-9);
    const double slow_torque =
        radius_mm * slow.chip_mm2 * (b.cos_inclination + 0.5 * b.sin_inclination * b.sin_inclination);
    EXPECT_NEAR(slow.torque_n_mm, slow_torque, 1e-8 * slow_torque) << "radius " << radius_mm;
  }
}

TEST(ObliqueCutting, SpindleAndFeedDoTheWorkOfTheForces) {
  // Torque times angle plus thrust times feed, over a revolution, is what the force does on the element's
  // way. A.15 as printed, with y' in the place of y, does not keep it.
  for (const double radius_mm : radii_mm)
    for (const double feed_mm : feeds_mm) {
      const ElementLoad load =
          element_load(ellipse_element(radius_mm, 0.1), thesis_offset_mm(), {}, {feed_mm});
      const VectorReference v(radius_mm, thesis_offset_mm(), rise_of_ellipse(radius_mm), feed_mm);
      const double path_mm = std::hypot(2.0 * pi * radius_mm, feed_mm);
      const double work = -load.chip_mm2 * path_mm * v.velocity.dot(v.across_rake + 0.5 * v.chip_drag());
      EXPECT_NEAR(2.0 * pi * load.torque_n_mm + feed_mm * load.thrust_n, work, 1e-12 * work)
          << "radius " << radius_mm << " feed " << feed_mm;
    }
}

TEST(ObliqueCutting, TransformsAreOrthonormal) {
  for (const double radius_mm : radii_mm)
    for (const double feed_mm : feeds_mm)
      for (const double rake_rad : {-0.3, 0.0, 0.2}) {
        const CuttingAngles a = cutting_angles(ellipse_element(radius_mm, 0.1), thesis_offset_mm(), feed_mm);
        const Mat3 r = machining_from_cutting(a);
        EXPECT_NEAR((r.transpose() * r - Mat3::Identity()).norm(), 0.0, 1e-14);
        EXPECT_NEAR(r.determinant(), 1.0, 1e-14);
        const RakeDirections d = cutting_from_rake(a, rake_rad);
        EXPECT_NEAR((d.transpose() * d - Eigen::Matrix2d::Identity()).norm(), 0.0, 1e-14);
      }
}

TEST(ObliqueCutting, PrintedA9IsRejected) {
  // Entry (2, 2) as printed has the other sign: its columns are not orthogonal, and friction would push the
  // lip on its way instead of holding it back.
  const CuttingAngles a = cutting_angles(ellipse_element(6.0, 0.1), thesis_offset_mm(), 0.09);
  RakeDirections printed = cutting_from_rake(a, 0.0);
  printed(1, 1) = -printed(1, 1);
  EXPECT_GT(std::abs(printed.col(0).dot(printed.col(1))), 0.1);
  EXPECT_GT(printed(1, 1), 0.0) << "along the velocity";
  EXPECT_LT(cutting_from_rake(a, 0.0)(1, 1), 0.0) << "against the velocity";
}

TEST(ObliqueCutting, PrintedA7IsRejected) {
  // Without 1/b the point angle is not the meridian's: the surface it would belong to is another.
  for (const double radius_mm : {4.0, 10.0, 17.0}) {
    const double step_mm = 1e-4;
    const auto height = [](double r) {
      return -ellipse_b_mm * std::sqrt(1.0 - r * r / (ellipse_a_mm * ellipse_a_mm));
    };
    const double rise = (height(radius_mm + step_mm) - height(radius_mm - step_mm)) / (2.0 * step_mm);
    const LipElement element = ellipse_element(radius_mm, 0.1);
    EXPECT_NEAR(element.point_angle_cosine / element.point_angle_sine, rise, 1e-6 * rise);
    const double printed =
        ellipse_a_mm * std::sqrt(ellipse_a_mm * ellipse_a_mm - radius_mm * radius_mm) / radius_mm;
    EXPECT_GT(std::abs(printed * rise - 1.0), 5.0) << "radius " << radius_mm;
  }
}

TEST(ObliqueCutting, StaysFiniteWhereTheLipBegins) {
  // At r = 3.00 mm the lip runs along its own motion: beta is 90 degrees and w unbounded, but not l w.
  const double offset_mm = thesis_offset_mm();
  const ElementLoad at = element_load(ellipse_element(offset_mm, 0.1), offset_mm, {}, {0.09});
  EXPECT_NEAR(at.chip_mm2, 0.09 / 5.0 * 0.1, 1e-7);
  ElementLoad before = at;
  for (const double beyond_mm : {1e-9, 1e-6, 1e-4}) {
    const ElementLoad near = element_load(ellipse_element(offset_mm + beyond_mm, 0.1), offset_mm, {}, {0.09});
    const double change = 20.0 * std::sqrt(beyond_mm) * at.chip_mm2;  // a root opens there
    EXPECT_NEAR(near.thrust_n, before.thrust_n, change);
    EXPECT_NEAR(near.torque_n_mm, before.torque_n_mm, 3.0 * change);
    before = near;
  }
  // All friction can do there is to lift a little, and the face pulls down.
  EXPECT_LT(at.thrust_n, 0.0);
}

TEST(ObliqueCutting, AtTheRimOnlyTorqueIsLeft) {
  // At r = a the lip runs along the axis: it turns bone off but meets no thrust beyond the climb of the feed.
  const ElementLoad rim = element_load(ellipse_element(ellipse_a_mm, 0.1), thesis_offset_mm(), {}, {0.09});
  EXPECT_NEAR(rim.depth_of_cut_mm, 0.0, 1e-15);
  EXPECT_NEAR(rim.chip_mm2, 0.09 / 5.0 * 0.1, 1e-8);
  EXPECT_NEAR(rim.thrust_n / rim.chip_mm2, 0.0, 1e-3);
  EXPECT_NEAR(rim.torque_n_mm / rim.chip_mm2, ellipse_a_mm, 1e-4);
  for (const double before_mm : {1e-8, 1e-6, 1e-4}) {
    const ElementLoad near =
        element_load(ellipse_element(ellipse_a_mm - before_mm, 0.1), thesis_offset_mm(), {}, {0.09});
    EXPECT_NEAR(near.thrust_n, rim.thrust_n, 3.0 * std::sqrt(before_mm) * rim.chip_mm2);
    EXPECT_NEAR(near.torque_n_mm, rim.torque_n_mm, 3.0 * std::sqrt(before_mm) * rim.torque_n_mm);
  }
}

TEST(ObliqueCutting, AFlatAndAHollowAreTheVectorsToo) {
  // Flat lips of a mesh tool, and a surface that comes forward again outwards: there tau turns negative,
  // which the arc cosine of A.11 cannot say.
  for (const double rise : {0.0, -0.4})
    for (const double radius_mm : {3.5, 8.0}) {
      const double length = std::sqrt(1.0 + rise * rise);
      const LipElement element{radius_mm, 0.1, 1.0 / length, rise / length};
      const VectorReference v(radius_mm, 3.0, rise, 0.3);
      const Mat3 r = machining_from_cutting(cutting_angles(element, 3.0, 0.3));
      EXPECT_NEAR((r.col(0) - (v.edge + v.sin_inclination() * v.velocity).normalized()).norm(), 0.0, 1e-12);
      EXPECT_LT(r(2, 0), 0.0);
    }
}

TEST(ObliqueCutting, ChipsAreTheRemovedVolume) {
  // Chip area times speed, over five lips: what the feed sweeps from the lip's inner to its outer end.
  const Lip lip = thesis_lip(500);
  for (const double feed_mm : feeds_mm) {
    double volume_mm3_s = 0.0;
    for (const ElementLoad& load : lip_loads(lip, {}, {feed_mm})) {
      const double turn_mm = 2.0 * pi * load.radius_mm;
      const double speed_mm_s =
          std::sqrt(turn_mm * turn_mm + feed_mm * feed_mm) * reference_spindle_rad_s / (2.0 * pi);
      volume_mm3_s += lip_count * load.chip_mm2 * speed_mm_s;
    }
    const double area_mm2 = pi * (ellipse_a_mm * ellipse_a_mm - lip.offset_mm * lip.offset_mm);
    const double feed_mm_s = feed_mm * reference_spindle_rad_s / (2.0 * pi);
    EXPECT_NEAR(volume_mm3_s, area_mm2 * feed_mm_s, 1e-9 * area_mm2 * feed_mm_s) << "feed " << feed_mm;
  }
}

TEST(ObliqueCutting, ElementsConvergeFast) {
  const auto whole = [](int count) { return whole_load(lip_loads(thesis_lip(count), {}, {0.09})); };
  const LipLoad fine = whole(20000), usual = whole(200);
  EXPECT_NEAR(usual.thrust_n, fine.thrust_n, 1e-3 * fine.thrust_n);
  EXPECT_NEAR(usual.torque_n_mm, fine.torque_n_mm, 1e-4 * fine.torque_n_mm);
}

TEST(ObliqueCutting, LeavingTheOffsetToTheWebAngleMattersLittle) {
  // A lip that lies on the swept surface rises by dz/dr times dr/ds along its own line; taking dz/dr (A.7
  // with y_A = r) changes torque over thrust by a few percent.
  Lip exact = thesis_lip(500);
  for (LipElement& e : exact.elements) {
    const double out = std::sqrt(1.0 - exact.offset_mm * exact.offset_mm / (e.radius_mm * e.radius_mm));
    const double rise = e.point_angle_cosine / e.point_angle_sine * out,
                 length = std::sqrt(1.0 + rise * rise);
    e.point_angle_sine = 1.0 / length;
    e.point_angle_cosine = rise / length;
  }
  const LipLoad taken = whole_load(lip_loads(thesis_lip(500), {}, {0.09}));
  const LipLoad on_surface = whole_load(lip_loads(exact, {}, {0.09}));
  EXPECT_NEAR(taken.torque_n_mm / taken.thrust_n * on_surface.thrust_n / on_surface.torque_n_mm, 1.0, 0.04);
}

TEST(ObliqueCutting, PowerLawsScaleEachElement) {
  const LipElement element = ellipse_element(12.0, 0.1);
  const auto load = [&](const CuttingCoefficients& c, double feed_mm, double rad_s) {
    return element_load(element, thesis_offset_mm(), c, {feed_mm, rad_s});
  };
  const CuttingCoefficients plain{}, deep{0.5, -0.3, 0.0, 0.0, 0.0}, fast{0.5, 0.0, 0.2, 0.0, 0.0},
      slippery{0.5, 0.0, 0.0, -0.1, -0.2};
  const ElementLoad base = load(plain, 0.09, 20.0);
  const double depth = base.depth_of_cut_mm / reference_depth_of_cut_mm;
  EXPECT_NEAR(load(deep, 0.09, 20.0).thrust_n, base.thrust_n * std::pow(depth, -0.3), 1e-12);
  EXPECT_NEAR(load(fast, 0.09, 40.0).torque_n_mm, load(fast, 0.09, 20.0).torque_n_mm * std::pow(2.0, 0.2),
              1e-12);
  EXPECT_EQ(load(plain, 0.09, 40.0).thrust_n, base.thrust_n);
  const double friction =
      0.5 * std::pow(depth, -0.1) * std::pow(20.0 * 12.0 / reference_lip_speed_mm_s, -0.2);
  EXPECT_NEAR(load(slippery, 0.09, 20.0).thrust_n, load({friction}, 0.09, 20.0).thrust_n,
              1e-6 * base.thrust_n);
}

TEST(ObliqueCutting, ThrustOfEveryElementBeyondTheInnermostIsPositive) {
  for (const double feed_mm : feeds_mm)
    for (const ElementLoad& load : lip_loads(thesis_lip(2000), {}, {feed_mm})) {
      if (load.radius_mm > 3.25) {
        EXPECT_GT(load.thrust_n, 0.0) << load.radius_mm;
      }
      EXPECT_GT(load.torque_n_mm, 0.0) << load.radius_mm;
    }
}

}  // namespace
}  // namespace ream::force
