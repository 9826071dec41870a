#include "score/depth_gauge.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "support/analytic_glenoid.hpp"
#include "support/seed.hpp"

namespace ream::score {
namespace {

using test::AnalyticGlenoid;

constexpr double tool_radius_mm = 30.0, tool_width_mm = 11.0;

/// An analytic glenoid, and spherical reamers that have been in it.
class Gauged : public testing::TestWithParam<double> {
 protected:
  Gauged() {
    Task task;
    task.anatomy.side = glenoid_.shoulder.side;
    case_::Plan plan;
    plan.entry_mm = glenoid_.mirrored(glenoid_.frame().centre);
    plan.axis_direction = glenoid_.mirrored(-glenoid_.frame().n);
    task.plan = plan;
    task.reamer = shell::make_tool("sphere 30,11").profile;
    native_ = std::make_shared<const NativeGlenoid>(task, bone_);
    into_bone_ = plan.axis_direction;
    entry_mm_ = plan.entry_mm;
  }

  /// Takes away what a reamer swept that came in along `axis` until its apex stood at `apex_mm`.
  void ream(const Vec3& apex_mm, const Vec3& axis) {
    const Vec3 centre = apex_mm - tool_radius_mm * axis;
    for (size_t i = 0; i < left_.size(); ++i) {
      if (left_[i] == 0) continue;
      const Vec3 from_centre =
          bone_.grid.world_from_grid.point(bone_.grid.centre_mm(bone_.grid.coordinates(i))) - centre;
      const double across = (from_centre - from_centre.dot(axis) * axis).norm();
      const double beyond_front = (from_centre.norm() - tool_radius_mm) / GetParam();
      const double beyond_side = (across - tool_width_mm) / GetParam();
      const double outside = from_centre.dot(axis) > 0.0 ? std::max(beyond_front, beyond_side) : beyond_side;
      left_[i] = std::min(left_[i], static_cast<uint8_t>(std::clamp(128.0 + 255.0 * outside, 0.0, 255.0)));
    }
  }

  /// By the formulas alone: the greatest way along the axis between the untouched sphere of the face and that
  /// of a reamer, over places a quarter of a millimetre apart.
  double true_depth_mm(const Vec3& apex_mm, const Vec3& axis) const {
    const test::GlenoidFormulas formulas(glenoid_);
    const Vec3 face = formulas.sphere_centre(), tool = apex_mm - tool_radius_mm * axis;
    const Vec3 u = into_bone_.unitOrthogonal(), v = into_bone_.cross(u);
    double deepest = 0.0;
    for (double x = -15.0; x <= 15.0; x += 0.1)
      for (double y = -15.0; y <= 15.0; y += 0.1) {
        const Vec3 from = entry_mm_ + x * u + y * v;
        const auto front = far_side(from, face, glenoid_.radius_mm),
                   swept = far_side(from, tool, tool_radius_mm);
        if (!front || !swept) continue;
        const Vec3 at_front = from + *front * into_bone_, at_swept = from + *swept * into_bone_;
        const Vec3 from_tool = at_swept - tool;
        if ((from_tool - from_tool.dot(axis) * axis).norm() > tool_width_mm) continue;
        if (formulas.beyond_wall_mm(at_front) > -1.0) continue;
        deepest = std::max(deepest, *swept - *front);
      }
    return deepest;
  }
  std::optional<double> far_side(const Vec3& from, const Vec3& centre, double radius_mm) const {
    const double b = into_bone_.dot(from - centre), c = (from - centre).squaredNorm() - radius_mm * radius_mm;
    if (b * b < c) return std::nullopt;
    return -b + std::sqrt(b * b - c);
  }

  double measured_mm() const { return DepthGauge(native_).measure({bone_.grid, left_.data()}); }
  /// Half of the depth's digit on the page and a quarter of a voxel, as a gauge may be off.
  double tolerance_mm() const { return std::max(0.1, 0.25 * GetParam()); }

  const AnalyticGlenoid glenoid_;
  const voxel::BoneModel bone_ = test::bone_of(glenoid_, GetParam());
  std::vector<uint8_t> left_ = bone_.coverage;
  std::shared_ptr<const NativeGlenoid> native_;
  Vec3 into_bone_, entry_mm_;
};

TEST_P(Gauged, UntouchedBoneIsReamedNowhere) { EXPECT_EQ(measured_mm(), 0.0); }

TEST_P(Gauged, ReadsWhatIsGoneWhereverTheReamerWas) {
  std::mt19937 random(test::seed(57));
  std::uniform_real_distribution<double> aside(-4.0, 4.0), deep(0.2, 3.0), tilt(-0.12, 0.12);
  const std::vector<uint8_t> untouched = left_;
  for (int i = 0; i < 8; ++i) {
    left_ = untouched;
    const Vec3 u = into_bone_.unitOrthogonal(), v = into_bone_.cross(u);
    const Vec3 axis = (into_bone_ + tilt(random) * u + tilt(random) * v).normalized();
    const Vec3 apex = entry_mm_ + aside(random) * u + aside(random) * v + deep(random) * into_bone_;
    ream(apex, axis);
    EXPECT_NEAR(measured_mm(), true_depth_mm(apex, axis), tolerance_mm()) << i;
  }
}

TEST_P(Gauged, StaysAtTheDeepestOfSeveralCuts) {
  ream(entry_mm_ + 1.5 * into_bone_, into_bone_);
  const double deep = measured_mm();
  EXPECT_NEAR(deep, 1.5, tolerance_mm());
  ream(entry_mm_ + 3.0 * into_bone_.unitOrthogonal() + 0.7 * into_bone_, into_bone_);
  EXPECT_EQ(measured_mm(), deep);
}

/// The final score looks at every ray, the gauge at few.
TEST_P(Gauged, AgreesWithTheFinalScore) {
  ream(entry_mm_ + 2.0 * into_bone_.unitOrthogonal() + 1.2 * into_bone_, into_bone_);
  const CoverageView left{bone_.grid, left_.data()};
  EXPECT_NEAR(measured_mm(), greatest_depth(*native_, achieved_face(*native_, left)).removed_mm, 0.02);
}

INSTANTIATE_TEST_SUITE_P(Voxels, Gauged, testing::Values(0.6, 0.3),
                         [](const auto& voxel) { return voxel.param == 0.6 ? "Coarse" : "Fine"; });

}  // namespace
}  // namespace ream::score
