#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>

#include "case/measures.hpp"
#include "core/units.hpp"
#include "ct/build/bone_from_mask.hpp"
#include "ct/phantom/individual.hpp"
#include "ct/phantom/phantom_case.hpp"
#include "ct/phantom/phantom_shape.hpp"
#include "ct/segment/shoulder_bones.hpp"
#include "support/full_tests.hpp"
#include "unit/ct/shoulder_phantom.hpp"

namespace ream::ct {
namespace {

constexpr int people = 50;

/// What somebody measures on the bone with a pair of callipers: nothing but which points lie in the bone.
class Callipers {
 public:
  explicit Callipers(const PhantomParams& params) : shape_(params), truth_(shape_.truth()) {
    const case_::Landmarks& l = truth_.landmarks;
    lateral_ = (*l.glenoid_centre_mm - *l.trigonum_mm).normalized();
    posterior_ = (*l.glenoid_centre_mm - *l.inferior_angle_mm).cross(lateral_).normalized();
    if (posterior_.y() < 0.0) posterior_ = -posterior_;  // LPS
    superior_ = posterior_.cross(lateral_);
    if (superior_.z() < 0.0) superior_ = -superior_;
  }

  Vec3 world(double lateral, double superior, double posterior) const {
    return *truth_.landmarks.glenoid_centre_mm + lateral * lateral_ + superior * superior_ +
           posterior * posterior_;
  }
  bool in_bone(const Vec3& p) const { return shape_.scapula_mm(p) < 0.0; }

  /// The farthest point of the bone within a box of the scapular frame (lateral, superior, posterior), in a
  /// direction of that frame, to half a millimetre.
  Vec3 farthest(const Vec3& direction, const Vec3& low, const Vec3& high) const {
    constexpr double coarse = 1.5, fine = 0.5;
    const Vec3 about = farthest_of_steps(direction, low, high, coarse);
    const Vec3 around = Vec3::Constant(coarse);
    return farthest_of_steps(direction, (about - around).cwiseMax(low), (about + around).cwiseMin(high),
                             fine);
  }

  /// Bone along a line through a point, mm.
  double thickness_mm(const Vec3& at, const Vec3& direction) const {
    constexpr double step = 0.05, reach = 15.0;
    int inside = 0;
    for (double s = -reach; s <= reach; s += step) {
      const Vec3 p = at + s * direction;
      inside += in_bone(world(p.x(), p.y(), p.z()));
    }
    return inside * step;
  }
  const GroundTruth& truth() const { return truth_; }

 private:
  Vec3 farthest_of_steps(const Vec3& direction, const Vec3& low, const Vec3& high, double step) const {
    double best = -1e9;
    Vec3 at = Vec3::Zero();
    for (double x = low.x(); x <= high.x(); x += step)
      for (double y = low.y(); y <= high.y(); y += step)
        for (double z = low.z(); z <= high.z(); z += step) {
          const double along = direction.dot(Vec3(x, y, z));
          if (along <= best || !in_bone(world(x, y, z))) continue;
          best = along;
          at = {x, y, z};
        }
    EXPECT_GT(best, -1e9);
    return at;
  }

  PhantomShape shape_;
  GroundTruth truth_;
  Vec3 lateral_, superior_, posterior_;
};

/// Compact bone under the middle of the face, along its normal.
double plate_mm(const PhantomParams& params, const GroundTruth& truth) {
  constexpr double step = 0.02, compact_g_cc = 1.3;
  const auto density = true_density_g_cc(params);
  double depth = step;
  while (density(truth.glenoid.centre_mm - depth * truth.glenoid.lateral) > compact_g_cc) depth += step;
  return depth;
}

struct Series {
  const char* name;
  double published_mean, published_sd;
  double sum = 0, squares = 0, low = 1e9, high = -1e9;
  int count = 0;

  void take(double value) {
    sum += value;
    squares += value * value;
    low = std::min(low, value);
    high = std::max(high, value);
    ++count;
  }
  double mean() const { return sum / count; }
  double sd() const { return std::sqrt((squares - sum * sum / count) / (count - 1)); }

  /// Both mean and spread like people's.
  void check() const {
    std::printf("%-34s %7.2f +- %5.2f (%.1f to %.1f), published %.1f +- %.1f\n", name, mean(), sd(), low,
                high, published_mean, published_sd);
    EXPECT_NEAR(mean(), published_mean, published_sd) << name;
    EXPECT_GT(sd(), published_sd / 2.0) << name;
    EXPECT_LT(sd(), published_sd * 1.5) << name;
  }
};

TEST(AnatomicalPhantom, FiftyPeopleMeasureAsPublishedSeriesDo) {
  Series height{"glenoid height, mm", 36.3, 4.0}, width{"glenoid width, mm", 25.2, 3.1};
  Series version{"version, degrees", -3.0, 5.0}, inclination{"inclination, degrees", 5.0, 5.0};
  Series length{"scapula's length, mm", 140.5, 11.0}, breadth{"scapula's breadth, mm", 104.8, 8.0};
  Series spine{"spine's length, mm", 128.9, 9.4},
      shoulder_angle{"critical shoulder angle, degrees", 29.8, 3.5};
  Series between{"acromion to coracoid, mm", 31.1, 4.1}, prominence{"coracoid beyond the rim, mm", 14.9, 6.0};
  Series acromion{"acromion's length, mm", 44.1, 4.7}, plate{"subchondral plate, mm", 1.9, 0.4};
  for (uint64_t number = 1; number <= people; ++number) {
    const PhantomParams params = individual(number);
    const Callipers bone(params);
    plate.take(plate_mm(params, bone.truth()));
    const case_::Landmarks& l = bone.truth().landmarks;
    const case_::Measures m = case_::measure(l, case_::Side::right);
    height.take((*l.superior_rim_mm - *l.inferior_rim_mm).norm());
    width.take((*l.anterior_rim_mm - *l.posterior_rim_mm).norm());
    version.take(degrees_from_radians(*m.version_3d_rad));
    inclination.take(degrees_from_radians(*m.inclination_3d_rad));

    const Vec3 up(0, 1, 0), out(1, 0, 0), front(0, 0, -1);
    const Vec3 top = bone.farthest(up, {-110, 15, -12}, {-70, 60, 14});
    const Vec3 bottom = bone.farthest(-up, {-110, -130, -12}, {-55, -70, 14});
    length.take((top - bottom).norm());
    const Vec3 root = bone.farthest(-out, {-125, -4, -6}, {-80, 4, 10});
    breadth.take((Vec3(0, 0, 0) - root).norm());

    const Vec3 acromion_tip = bone.farthest(front, {15, 30, -15}, {45, 52, 20});
    const Vec3 acromion_back = bone.farthest(-front, {6, 18, 10}, {45, 50, 50});
    acromion.take((acromion_tip - acromion_back).norm());
    spine.take((acromion_tip - root).norm());
    const Vec3 coracoid_tip = bone.farthest({1, -0.5, -1}, {-12, 10, -50}, {35, 45, -14});
    between.take((acromion_tip - coracoid_tip).norm());
    const Vec3 edge = bone.farthest(out, {10, 26, -20}, {50, 50, 38});
    const Vec3 under = bone.farthest(-up, {edge.x() - 1.5, 20, -20}, {edge.x(), 50, 38});
    const auto scapular = [&](const Vec3& world_mm) {
      const Vec3 d = world_mm - bone.world(0, 0, 0);
      return Vec3(d.dot(bone.world(1, 0, 0) - bone.world(0, 0, 0)),
                  d.dot(bone.world(0, 1, 0) - bone.world(0, 0, 0)),
                  d.dot(bone.world(0, 0, 1) - bone.world(0, 0, 0)));
    };
    const Vec3 above = scapular(*l.superior_rim_mm), below = scapular(*l.inferior_rim_mm);
    const auto tilt = [&](const Vec3& to) { return std::atan2(to.x() - below.x(), to.y() - below.y()); };
    shoulder_angle.take(degrees_from_radians(tilt(under) - tilt(above)));
    prominence.take(bone.farthest(out, {-12, 10, -50}, {35, 45, -16}).x() - scapular(*l.anterior_rim_mm).x());
  }
  for (const Series* s : {&height, &width, &version, &inclination, &length, &breadth, &spine, &acromion,
                          &shoulder_angle, &between, &prominence, &plate})
    s->check();
}

/// Middle third 2.06 mm, lateral border 8.2 +- 2.0 a centimetre from its edge.
TEST(AnatomicalPhantom, TheBodyIsThinInItsMiddleAndThickAlongItsLateralBorder) {
  PhantomParams params;
  params.anatomical = AnatomicalSizes{};
  const Callipers bone(params);
  const Vec3 across(0, 0, 1);
  EXPECT_NEAR(bone.thickness_mm({-82, -35, 0}, across), 2.06, 1.0);
  // The border runs from the neck down to the inferior angle; so far in from its edge, half way.
  const Vec3 along = Vec3(-88 + 42, -108 + 42, 0).normalized(), inwards(along.y(), -along.x(), 0);
  ASSERT_LT(inwards.x(), 0.0);
  Vec3 edge(-66, -70, 0);
  ASSERT_TRUE(bone.in_bone(bone.world(edge.x(), edge.y(), edge.z())));
  while (bone.in_bone(bone.world(edge.x(), edge.y(), edge.z()))) edge -= 0.1 * inwards;
  EXPECT_NEAR(bone.thickness_mm(edge + 10.0 * inwards, across), 8.2, 2.0) << edge.transpose();
}

/// The demo is anatomical, and yet every recording of it keeps its bone.
TEST(AnatomicalPhantom, WhatAReamerMeetsIsThatOfTheSimplePhantomToTheBit) {
  PhantomParams with = phantom_preset("demo").params, without = with;
  ASSERT_TRUE(with.anatomical);
  without.anatomical.reset();
  for (PhantomParams* p : {&with, &without}) p->spacing_mm = Vec3::Constant(0.8);
  EXPECT_EQ(make_phantom(with).volume.hu, make_phantom(without).volume.hu);
  with.field_mm = without.field_mm = {{-60, -55, -40}, {60, 50, 50}};
  for (PhantomParams* p : {&with, &without}) p->spacing_mm = Vec3::Constant(2.0);
  EXPECT_NE(make_phantom(with).volume.hu, make_phantom(without).volume.hu) << "beyond, they differ";
}

constexpr PhantomType walch_types[] = {PhantomType::a1, PhantomType::a2, PhantomType::b1, PhantomType::b2,
                                       PhantomType::b3, PhantomType::c1, PhantomType::d};

/// Whatever was drawn and however the head has moved: two bones, and a class that is what it is called.
TEST(AnatomicalPhantom, OfAnyTypeAnIndividualHasTwoBonesAndItsClass) {
  for (uint64_t number = 1; number <= 12; ++number)
    for (const PhantomType type : walch_types) {
      SCOPED_TRACE("person " + std::to_string(number) + ", " + to_text(type));
      PhantomParams params = individual(number);
      params.type = type;
      const PhantomShape shape(params);
      const GroundTruth truth = shape.truth();
      size_t in_both = 0, in_humerus = 0;
      for (double x = -40; x <= 40; x += 2)
        for (double y = -40; y <= 40; y += 2)
          for (double z = -40; z <= 40; z += 2) {
            const Vec3 p = truth.humeral_head_centre_mm + Vec3(x, y, z);
            if (shape.humerus_mm(p) >= 0.0) continue;
            ++in_humerus;
            in_both += shape.scapula_mm(p) < 0.0;
          }
      EXPECT_GT(in_humerus, 5000u);
      EXPECT_EQ(in_both, 0u);
      const case_::Measures m = case_::measure(truth.landmarks, params.side);
      const double version_deg = degrees_from_radians(*m.version_3d_rad);
      const double back_percent = *m.subluxation_percent;
      EXPECT_TRUE(type != PhantomType::b1 || back_percent > 55.0) << back_percent;
      EXPECT_TRUE(type != PhantomType::b3 || version_deg < -15.0) << version_deg;
      EXPECT_TRUE(type != PhantomType::c1 || version_deg < -25.0) << version_deg;
      EXPECT_TRUE(type != PhantomType::d || (version_deg > 0.0 && back_percent < 40.0)) << back_percent;
    }
}

TEST(AnatomicalPhantom, WhatWearDoesToTheGlenoidIsNotDoneToTheHead) {
  for (const PhantomType type : {PhantomType::b2, PhantomType::b3}) {
    PhantomParams params;
    params.type = type;
    params.noise_hu = 0.0;
    params.spacing_mm = Vec3::Constant(2.0);
    const Phantom phantom = make_phantom(params);
    const HuVolume& volume = phantom.volume;
    const double sclerotic_hu = hu_of_apparent_density(1.0, params.calibration);
    size_t spongy = 0;
    for (size_t i = 0; i < volume.hu.size(); ++i) {
      const int row = volume.dims.x(), page = row * volume.dims.y();
      const auto at = static_cast<int>(i);
      const Vec3 p = volume.world_of_centre({at % row, at % page / row, at / page});
      if ((p - phantom.truth.humeral_head_centre_mm).norm() > phantom.truth.humeral_head_radius_mm - 4.0)
        continue;
      ++spongy;
      EXPECT_LT(volume.hu[i], sclerotic_hu) << to_text(type);
    }
    EXPECT_GT(spongy, 500u);
  }
}

/// The vertices of pictures lie on the bone of the formulas, also of a left shoulder.
TEST(AnatomicalPhantom, ItsSurfaceForPicturesIsItsSurface) {
  for (const case_::Side side : {case_::Side::right, case_::Side::left}) {
    PhantomParams params = individual(4);
    params.side = side;
    const TriangleMesh surface = scapula_surface(params, 2.0);
    PhantomParams right = params;
    right.side = case_::Side::right;
    const PhantomShape shape(right);
    const double mirror = side == case_::Side::left ? -1.0 : 1.0;
    size_t off = 0;
    for (const Vec3f& vertex : surface.vertices_mm)
      off += std::abs(shape.scapula_mm(vertex.cast<double>().cwiseProduct(Vec3(mirror, 1, 1)))) > 0.05;
    EXPECT_GT(surface.vertices_mm.size(), 5000u);
    EXPECT_LT(static_cast<double>(off), 0.01 * static_cast<double>(surface.vertices_mm.size()));
  }
}

TEST(AnatomicalPhantom, ALeftOneIsTheMirrorImageVoxelForVoxel) {
  PhantomParams params = individual(5);
  params.spacing_mm = Vec3::Constant(3.0);
  const HuVolume right = make_phantom(params).volume;
  params.side = case_::Side::left;
  const HuVolume left = make_phantom(params).volume;
  ASSERT_EQ(left.dims, right.dims);
  for (int w = 0; w < right.dims.z(); ++w)
    for (int v = 0; v < right.dims.y(); ++v)
      for (int u = 0; u < right.dims.x(); ++u)
        ASSERT_EQ(left.hu[left.index(right.dims.x() - 1 - u, v, w)], right.hu[right.index(u, v, w)]);
}

TEST(AnatomicalPhantom, ANumberIsOnePersonAndNumbersAreDifferentPeople) {
  const PhantomParams seven = individual(7), again = individual(7), eight = individual(8);
  EXPECT_EQ(seven.glenoid_height_mm, again.glenoid_height_mm);
  EXPECT_EQ(seven.anatomical->scale, again.anatomical->scale);
  EXPECT_NE(seven.glenoid_height_mm, eight.glenoid_height_mm);
  EXPECT_NE(seven.anatomical->coracoid_lateral_mm, eight.anatomical->coracoid_lateral_mm);
}

/// As a user's CT would be segmented, without a seed point. Three people, in full tests twenty;
/// REAM_INDIVIDUALS sets how many.
TEST(AnatomicalPhantom, PeoplesScapulaeAreSegmentedApartFromTheirHumerus) {
  const char* wanted = std::getenv("REAM_INDIVIDUALS");
  const uint64_t count = wanted ? std::strtoull(wanted, nullptr, 10) : test::full_tests() ? 20 : 3;
  ASSERT_GT(count, 0u);
  double least = 1.0;
  size_t most_wrong = 0;
  for (uint64_t number = 1; number <= count; ++number) {
    SCOPED_TRACE("person " + std::to_string(number));
    PhantomParams params = individual(number);
    params.spacing_mm = Vec3(1.0, 1.0, 1.25);
    const Phantom phantom = make_phantom(params);
    const std::vector<uint8_t> truth = true_labels(phantom.volume, params);
    SegmentationSettings settings;
    settings.side = params.side;
    const Segmentation found = segment_shoulder(phantom.volume, settings);
    const double agreement = dice(found.labels, truth, 1);
    const size_t wrong = count_both(found.labels, 1, truth, 2) + count_both(found.labels, 2, truth, 1);
    // The body is two voxels thin: a threshold takes what bone fills by a quarter.
    EXPECT_GT(agreement, 0.9);
    EXPECT_GT(count_both(found.labels, 1, truth, 1), count_both(truth, 1, truth, 1) * 97 / 100);
    EXPECT_LT(wrong, 50u) << "taken for the other bone";
    ASSERT_TRUE(found.head);
    EXPECT_LT((found.head->centre_mm - phantom.truth.humeral_head_centre_mm).norm(), 1.5);
    least = std::min(least, agreement);
    most_wrong = std::max(most_wrong, wrong);
  }
  std::printf("scapulae of %d people: least Dice %.4f, at most %zu voxels taken for the other bone\n",
              static_cast<int>(count), least, most_wrong);
}

/// Along lines through all of it: what jumped would be steep for a gradient, and stand in the air as bone.
TEST(AnatomicalPhantom, ProcessesAreContinuousAsFarAsTheyCount) {
  std::mt19937_64 random(20261127);
  std::uniform_real_distribution<double> even(-1.0, 1.0);
  for (const double scale : {0.8, 1.0, 1.25}) {
    AnatomicalSizes sizes;
    sizes.scale = scale;
    const AnatomicalScapula scapula(sizes);
    double steepest = 0.0;
    for (int line = 0; line < 300; ++line) {
      constexpr double step_mm = 0.02;
      const Vec3 through(-30.0 + 60.0 * even(random), 10.0 + 60.0 * even(random), 50.0 * even(random));
      const Vec3 along = Vec3(even(random), even(random), even(random)).normalized();
      double last = scapula.processes_value(through - 60.0 * along);
      for (double at = -60.0 + step_mm; at < 60.0; at += step_mm) {
        const double value = scapula.processes_value(through + at * along);
        if (std::min(value, last) < AnatomicalScapula::far_mm)
          steepest = std::max(steepest, std::abs(value - last) / step_mm);
        last = value;
      }
    }
    EXPECT_LT(steepest, 1.3) << "scale " << scale;
    EXPECT_GT(steepest, 0.8);
  }
}

}  // namespace
}  // namespace ream::ct
