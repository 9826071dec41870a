#include <gtest/gtest.h>

#include <iostream>

#include "ct/read/read_ct.hpp"
#include "ct/segment/label_map.hpp"
#include "support/shared_data.hpp"
#include "unit/ct/shoulder_phantom.hpp"

namespace ream::ct {
namespace {

SegmentationSettings of_side(case_::Side side) {
  SegmentationSettings settings;
  settings.side = side;
  return settings;
}

const BonePart& part(const Segmentation& segmentation, BoneLabel label) {
  for (const BonePart& p : segmentation.parts)
    if (p.label == label) return p;
  throw std::runtime_error("no " + to_text(label));
}

void compare(const HuVolume& ct, const Segmentation& ours, const HuVolume& map) {
  const Segmentation theirs = segmentation_from_labels(ct, map);
  std::cout << "threshold " << ours.threshold_hu << " HU, scapula " << dice(ours.labels, theirs.labels, 1)
            << " Dice, " << part(ours, BoneLabel::scapula).voxels << " voxels\n";
  EXPECT_GE(dice(ours.labels, theirs.labels, 1), 0.97);
  EXPECT_EQ(count_both(ours.labels, 1, theirs.labels, 2), 0u) << "humerus in the scapula";
  EXPECT_EQ(count_both(ours.labels, 1, theirs.labels, 3), 0u) << "clavicle in the scapula";
  EXPECT_EQ(count_both(ours.labels, 2, theirs.labels, 1), 0u) << "scapula in the humerus";
}

TEST(SharedSegmentation, CropOfTheRightShoulder) {
  const auto ct = test::shared_data("ct/shoulder_right_ct.nii.gz"),
             label = test::shared_data("ct/shoulder_right_label.nii.gz");
  REAM_SKIP_WITHOUT(ct);
  REAM_SKIP_WITHOUT(label);
  const HuVolume volume = read_ct(ct);
  EXPECT_GE(suggested_threshold_hu(volume), 150.0);
  EXPECT_LE(suggested_threshold_hu(volume), 300.0);
  compare(volume, segment_shoulder(volume, of_side(case_::Side::right)), read_volume_file(label));
  // At 150 HU the joint space, the clavicle and the blade's muscle border all run together.
  SegmentationSettings low = of_side(case_::Side::right);
  low.threshold_hu = 150.0;
  const Segmentation touching = segment_shoulder(volume, low);
  const Segmentation theirs = segmentation_from_labels(volume, read_volume_file(label));
  EXPECT_GE(dice(touching.labels, theirs.labels, 1), 0.9);
  EXPECT_LT(count_both(touching.labels, 1, theirs.labels, 2), 50u);
}

TEST(SharedSegmentation, BothShouldersOfAChest) {
  const auto ct = test::shared_data("ct/shoulder_dicom"),
             label = test::shared_data("ct/shoulder_right_label.nii.gz");
  REAM_SKIP_WITHOUT(ct);
  REAM_SKIP_WITHOUT(label);
  const HuVolume volume = read_ct(ct);
  const Segmentation right = segment_shoulder(volume, of_side(case_::Side::right)),
                     left = segment_shoulder(volume, of_side(case_::Side::left));
  compare(volume, right, read_volume_file(label));
  const BonePart &a = part(right, BoneLabel::scapula), &b = part(left, BoneLabel::scapula);
  std::cout << "right " << a.volume_mm3 << " mm3, left " << b.volume_mm3 << " mm3\n";
  // The left one is cut off by the scan above and below.
  EXPECT_NEAR(b.volume_mm3 / a.volume_mm3, 1.0, 0.15);
  EXPECT_EQ(count_both(right.labels, 1, left.labels, 1), 0u);
  ASSERT_TRUE(left.head && right.head);
  EXPECT_NEAR(left.head->radius_mm, right.head->radius_mm, 2.0);
  EXPECT_LT(right.head->centre_mm.x(), left.head->centre_mm.x() - 250.0);
  // The left head belongs to the humerus and to nothing else.
  size_t foreign = 0;
  for (size_t i = 0; i < left.labels.size(); ++i) {
    if (left.labels[i] != 1) continue;
    const auto nx = static_cast<size_t>(volume.dims.x()), ny = static_cast<size_t>(volume.dims.y());
    const Vec3 place = volume.world_of_centre(
        {static_cast<int>(i % nx), static_cast<int>((i / nx) % ny), static_cast<int>(i / (nx * ny))});
    foreign += (place - left.head->centre_mm).norm() < left.head->radius_mm - 0.5;
  }
  EXPECT_EQ(foreign, 0u);
}

TEST(SharedSegmentation, ThickSlicesAndACtWithoutAShoulderAreWarnedOf) {
  const auto ct = test::shared_data("ct/shoulder_thick_slices_dicom");
  REAM_SKIP_WITHOUT(ct);
  const Segmentation made = segment_shoulder(read_ct(ct), of_side(case_::Side::right));
  ASSERT_EQ(made.warnings.size(), 2u);
  EXPECT_NE(made.warnings[0].find("slices of 8.0 mm"), std::string::npos);
  // These ten slices lie below the shoulders; no vertebra may pass for a head.
  EXPECT_FALSE(made.head);
  EXPECT_NE(made.warnings[1].find("no humeral head"), std::string::npos);
}

TEST(SharedSegmentation, AShoulderInThickSlicesStillComesApart) {
  const auto ct = test::shared_data("ct/shoulder_right_ct.nii.gz"),
             label = test::shared_data("ct/shoulder_right_label.nii.gz");
  REAM_SKIP_WITHOUT(ct);
  REAM_SKIP_WITHOUT(label);
  const HuVolume thin = read_ct(ct);
  HuVolume thick = thin;
  constexpr int slices = 4;  // of 1.25 mm
  thick.dims.z() /= slices;
  thick.spacing_mm.z() *= slices;
  thick.hu.assign(thick.voxel_count(), 0);
  for (int w = 0; w < thick.dims.z(); ++w)
    for (int v = 0; v < thick.dims.y(); ++v)
      for (int u = 0; u < thick.dims.x(); ++u) {
        int sum = 0;
        for (int k = 0; k < slices; ++k) sum += thin.hu[thin.index(u, v, slices * w + k)];
        thick.hu[thick.index(u, v, w)] = static_cast<int16_t>(sum / slices);
      }
  const Segmentation made = segment_shoulder(thick, of_side(case_::Side::right));
  const Segmentation theirs = segmentation_from_labels(thick, read_volume_file(label));
  std::cout << "slices of 5 mm: scapula " << dice(made.labels, theirs.labels, 1) << " Dice\n";
  ASSERT_TRUE(made.head);
  EXPECT_GE(dice(made.labels, theirs.labels, 1), 0.85);
  EXPECT_LT(count_both(made.labels, 1, theirs.labels, 2), 50u);
}

}  // namespace
}  // namespace ream::ct
