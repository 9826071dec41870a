#pragma once
#include <algorithm>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "core/progress.hpp"
#include "ct/segment/humeral_head.hpp"
#include "ct/segment/mask.hpp"
#include "ct/segment/threshold_suggestion.hpp"

namespace ream::ct {

/// What a voxel of a segmented CT belongs to. `scapula`, `humerus` and `clavicle` are those of the case's
/// side; the other shoulder's are `other`, as ribs and spine.
enum class BoneLabel : uint8_t { none = 0, scapula = 1, humerus = 2, clavicle = 3, other = 4 };
inline constexpr int bone_label_count = 5;
inline std::string to_text(BoneLabel label) {
  constexpr const char* words[] = {"none", "scapula", "humerus", "clavicle", "other"};
  return words[std::min(static_cast<size_t>(label), std::size(words) - 1)];
}

/// Points in bones, world (LPS) mm, that replace what is found by itself.
struct Seeds {
  std::optional<Vec3> scapula_mm, humerus_mm, clavicle_mm;
};

struct SegmentationSettings {
  std::optional<double> threshold_hu;  ///< suggested_threshold_hu where not given
  double sigma_mm = 0.0;               ///< Gaussian before everything
  bool separate = true;                ///< part touching bones; else only parts that do not touch are apart
  bool fill_holes = true;              ///< pores of thin bone, marrow and voids
  case_::Side side = case_::Side::right;
  Seeds seeds;
};

/// All voxels of one label; world mm, corners of their bounding box.
struct BonePart {
  BoneLabel label = BoneLabel::none;
  size_t voxels = 0;
  double volume_mm3 = 0.0;
  Vec3 centre_mm = Vec3::Zero(), low_mm = Vec3::Zero(), high_mm = Vec3::Zero();
};

struct Segmentation {
  std::vector<uint8_t> labels;  ///< BoneLabel per voxel of the CT, x fastest
  double threshold_hu = 0.0;    ///< that was used
  std::vector<BonePart> parts;  ///< those with voxels, by label
  std::optional<HumeralHead> head;
  /// About the middle of the scapula's face towards the head, good to some mm: to place a view or a region of
  /// interest. Empty without a head.
  std::optional<Vec3> glenoid_mm;
  std::vector<std::string> warnings;
};

/// Labels the bones of one shoulder in a CT of a shoulder, a chest or a whole body, whole or cropped.
///
/// The humeral head is found as the best sphere on the side asked for (humeral_head.hpp). Bone within it is
/// humerus, bone behind the joint space in the direction of the glenoid is scapula, and what lies where no
/// scapula reaches (well medial and in front of the head) is neither; from there labels flood all bone above
/// the threshold, densest first (bone_flood.hpp). Then the pores of the blade are closed where HU says that
/// there is something denser than soft tissue.
///
/// Errors: invalid_input when nothing reaches the threshold, a seed lies more than 5 mm from bone, the volume
/// holds no bone on the medial side of the head (the wrong side), or neither head nor seed is found and
/// nothing can be told apart.
Segmentation segment_shoulder(const HuVolume& volume, const SegmentationSettings& settings,
                              const Progress& progress = no_progress);

/// Counts, centres and boxes of the labels in a volume.
std::vector<BonePart> measure_parts(const HuVolume& volume, const std::vector<uint8_t>& labels);

/// 1 where the label is `label`.
Mask mask_of(const std::vector<uint8_t>& labels, BoneLabel label);

}  // namespace ream::ct
