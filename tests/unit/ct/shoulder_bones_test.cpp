#include "ct/segment/shoulder_bones.hpp"

#include <gtest/gtest.h>

#include "support/expect_error.hpp"
#include "unit/ct/shoulder_phantom.hpp"

namespace ream::ct {
namespace {

SegmentationSettings bone_of_side(case_::Side side) {
  SegmentationSettings settings;
  settings.side = side;
  return settings;
}

struct Joint {
  case_::Side side;
  double joint_space_mm, noise_hu, blur_mm;
};

class PhantomShoulder : public testing::TestWithParam<Joint> {};

TEST_P(PhantomShoulder, ScapulaComesApartFromTheHumerus) {
  const Joint& joint = GetParam();
  const PhantomParams params = shoulder_params(joint.side, joint.joint_space_mm, joint.noise_hu);
  HuVolume volume = make_phantom(params).volume;
  const std::vector<uint8_t> truth = true_labels(volume, params);
  smooth(volume, joint.blur_mm);
  const Segmentation made = segment_shoulder(volume, bone_of_side(joint.side));
  EXPECT_TRUE(made.warnings.empty());
  const auto scapula = count_both(truth, 1, truth, 1), humerus = count_both(truth, 2, truth, 2);
  // Where they touch, the cut may lie half a voxel off over all of the face.
  const size_t touching = joint.blur_mm > 0.0 ? 1 : 0;
  EXPECT_LE(count_both(made.labels, 1, truth, 2), touching * humerus / 200) << "humerus taken for scapula";
  EXPECT_LE(count_both(made.labels, 2, truth, 1), touching * scapula / 200) << "scapula taken for humerus";
  EXPECT_GT(count_both(made.labels, 1, truth, 1), scapula * 97 / 100);
  EXPECT_GT(count_both(made.labels, 2, truth, 2), humerus * 97 / 100);
}

// A joint space of 1 mm, blurred by 1.2 mm, is denser than the threshold all over: the bones touch.
INSTANTIATE_TEST_SUITE_P(Joints, PhantomShoulder,
                         testing::Values(Joint{case_::Side::right, 4.0, 15.0, 0.0},
                                         Joint{case_::Side::left, 4.0, 45.0, 0.0},
                                         Joint{case_::Side::right, 1.0, 15.0, 0.0},
                                         Joint{case_::Side::right, 1.0, 15.0, 1.2},
                                         Joint{case_::Side::left, 1.0, 45.0, 1.2}));

TEST(ShoulderBones, AMirroredShoulderGivesMirroredLabels) {
  const HuVolume right = make_phantom(shoulder_params(case_::Side::right)).volume,
                 left = make_phantom(shoulder_params(case_::Side::left)).volume;
  const Segmentation a = segment_shoulder(right, bone_of_side(case_::Side::right)),
                     b = segment_shoulder(left, bone_of_side(case_::Side::left));
  ASSERT_EQ(a.parts.size(), b.parts.size());
  for (size_t i = 0; i < a.parts.size(); ++i) {
    EXPECT_NEAR(static_cast<double>(a.parts[i].voxels) / static_cast<double>(b.parts[i].voxels), 1.0, 1e-3);
    EXPECT_LT((a.parts[i].centre_mm - Vec3(-1, 1, 1).cwiseProduct(b.parts[i].centre_mm)).norm(), 0.05);
  }
  ASSERT_TRUE(a.glenoid_mm && b.glenoid_mm);
  EXPECT_LT((*a.glenoid_mm - Vec3(-1, 1, 1).cwiseProduct(*b.glenoid_mm)).norm(), 0.1);
}

TEST(ShoulderBones, FindsTheHeadAndTheGlenoid) {
  const Phantom phantom = make_phantom(shoulder_params(case_::Side::left));
  const Segmentation made = segment_shoulder(phantom.volume, bone_of_side(case_::Side::left));
  ASSERT_TRUE(made.head);
  EXPECT_LT((made.head->centre_mm - phantom.truth.humeral_head_centre_mm).norm(), 1.0);
  EXPECT_NEAR(made.head->radius_mm, phantom.truth.humeral_head_radius_mm, 1.0);
  ASSERT_TRUE(made.glenoid_mm);
  EXPECT_LT((*made.glenoid_mm - phantom.truth.glenoid.centre_mm).norm(), 6.0);
}

TEST(ShoulderBones, SameVolumeSameLabels) {
  const HuVolume volume = make_phantom(shoulder_params(case_::Side::right)).volume;
  const Segmentation a = segment_shoulder(volume, bone_of_side(case_::Side::right)),
                     b = segment_shoulder(volume, bone_of_side(case_::Side::right));
  EXPECT_EQ(a.labels, b.labels);
}

TEST(ShoulderBones, PartsSumUpTheLabels) {
  const HuVolume volume = make_phantom(shoulder_params(case_::Side::right)).volume;
  const Segmentation made = segment_shoulder(volume, bone_of_side(case_::Side::right));
  for (const BonePart& part : made.parts) {
    const int label = static_cast<int>(part.label);
    EXPECT_EQ(part.voxels, count_both(made.labels, label, made.labels, label));
    EXPECT_NEAR(part.volume_mm3, static_cast<double>(part.voxels) * volume.spacing_mm.prod(), 1e-6);
    EXPECT_TRUE(Aabb({part.low_mm, part.high_mm}).contains(part.centre_mm));
  }
}

TEST(ShoulderBones, TheWrongSideIsRefused) {
  // The phantom's humerus is lateral of its scapula: taken for a left shoulder there is no bone medial of it.
  const HuVolume right = make_phantom(shoulder_params(case_::Side::right)).volume;
  test::expect_error(ErrorKind::invalid_input, "check the side",
                     [&] { segment_shoulder(right, bone_of_side(case_::Side::left)); });
}

TEST(ShoulderBones, SeedsReplaceWhatIsFound) {
  const PhantomParams params = shoulder_params(case_::Side::right);
  Phantom phantom = make_phantom(params);
  const case_::GlenoidFrame& glenoid = phantom.truth.glenoid;
  // Only the glenoid and a slice of the head: no sphere to be found.
  const HuVolume part =
      cropped(phantom.volume, {glenoid.centre_mm - Vec3(12, 18, 18), glenoid.centre_mm + Vec3(30, 18, 18)});
  SegmentationSettings settings = bone_of_side(case_::Side::right);
  const Segmentation unaided = segment_shoulder(part, settings);
  ASSERT_EQ(unaided.warnings.size(), 1u);
  EXPECT_NE(unaided.warnings[0].find("no humeral head"), std::string::npos);
  settings.seeds.scapula_mm = glenoid.centre_mm - 4.0 * glenoid.lateral;
  settings.seeds.humerus_mm = glenoid.centre_mm + 6.0 * glenoid.lateral;
  const Segmentation seeded = segment_shoulder(part, settings);
  EXPECT_TRUE(seeded.warnings.empty());
  const std::vector<uint8_t> truth = true_labels(part, params);
  EXPECT_EQ(count_both(seeded.labels, 1, truth, 2), 0u);
  EXPECT_GT(count_both(seeded.labels, 1, truth, 1), count_both(truth, 1, truth, 1) * 97 / 100);
  settings.seeds.scapula_mm = glenoid.centre_mm + Vec3(25, -15, 0);
  test::expect_error(ErrorKind::invalid_input, "scapula's seed", [&] { segment_shoulder(part, settings); });
}

TEST(ShoulderBones, UnseparatedTouchingBonesStayTogether) {
  HuVolume volume = make_phantom(shoulder_params(case_::Side::right, 1.0)).volume;
  const std::vector<uint8_t> truth = true_labels(volume, shoulder_params(case_::Side::right, 1.0));
  smooth(volume, 1.2);
  SegmentationSettings settings = bone_of_side(case_::Side::right);
  settings.separate = false;
  const Segmentation made = segment_shoulder(volume, settings);
  EXPECT_GT(count_both(made.labels, 1, truth, 2), count_both(truth, 2, truth, 2) / 2);
}

TEST(ShoulderBones, ProgressRisesAndCancelsWithoutHarm) {
  const HuVolume volume = make_phantom(shoulder_params(case_::Side::right)).volume;
  double last = 0.0;
  segment_shoulder(volume, bone_of_side(case_::Side::right), [&](double share, std::string_view step) {
    EXPECT_GE(share, last);
    EXPECT_LE(share, 1.0);
    EXPECT_FALSE(step.empty());
    last = share;
  });
  EXPECT_EQ(last, 1.0);
  test::expect_error(ErrorKind::cancelled, "enough", [&] {
    segment_shoulder(volume, bone_of_side(case_::Side::right), [](double share, std::string_view) {
      if (share > 0.4) throw Error(ErrorKind::cancelled, "enough");
    });
  });
}

TEST(ShoulderBones, AThresholdAboveEverythingIsRefused) {
  const HuVolume volume = make_phantom(shoulder_params(case_::Side::right)).volume;
  SegmentationSettings settings = bone_of_side(case_::Side::right);
  settings.threshold_hu = 3500.0;
  test::expect_error(ErrorKind::invalid_input, "3500 HU", [&] { segment_shoulder(volume, settings); });
}

}  // namespace
}  // namespace ream::ct
