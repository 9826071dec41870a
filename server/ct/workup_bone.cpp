#include "ct/workup_bone.hpp"

#include <algorithm>

#include "case/measures.hpp"
#include "core/error.hpp"
#include "ct/build_case.hpp"
#include "ct/voxel_window.hpp"

namespace ream::ct {
namespace {

constexpr double max_grid_voxels = 1.5e9;  // more than 3 GB of density and coverage

Error no_scapula(const Workup& workup) {
  return {ErrorKind::conflict,
          "case '" + workup.id + "' has no segmented scapula; segment it again with a seed in the scapula"};
}

const BonePart& scapula_part(const Workup& workup) {
  if (const SegmentationRecord* record = workup.segmentation())
    for (const BonePart& part : record->parts)
      if (part.label == BoneLabel::scapula) return part;
  throw no_scapula(workup);
}

/// The voxels that touch a world box, and `margin` more on every side.
VoxelWindow window_of(const HuVolume& volume, const Aabb& box_mm, int margin) {
  const Aabb box = box_mm.transformed(volume.world_from_volume.inverse());
  const auto voxel = [&](const Vec3& p) -> Vec3i {
    return (p.array() / volume.spacing_mm.array()).floor().max(-1e6).min(1e6).cast<int>().matrix();
  };
  const Vec3i low = (voxel(box.min).array() - margin).max(0).matrix();
  const Vec3i high = (voxel(box.max).array() + margin + 1).min(volume.dims.array()).matrix();
  return {low, (high - low).cwiseMax(0)};
}

/// The scapula's mask and HU within a window.
struct ScapulaPart {
  HuVolume volume;
  Mask mask;
};

ScapulaPart cut(const Workup& workup, const std::vector<int16_t>& hu, const std::vector<uint8_t>& labels,
                const VoxelWindow& window) {
  const HuVolume& whole = workup.volume;
  ScapulaPart part;
  part.volume = whole;
  part.volume.dims = window.dims;
  part.volume.world_from_volume.translation_mm = whole.world_from_volume.point(
      (window.low.cast<double>().array() * whole.spacing_mm.array()).matrix());
  part.volume.hu = cut_out(hu, whole.dims, window);
  part.mask = mask_of(cut_out(labels, whole.dims, window), BoneLabel::scapula);
  if (count_set(part.mask) == 0) throw no_scapula(workup);
  return part;
}

SegmentationOptions options_for(const Workup& workup, int upsample) {
  SegmentationOptions options;
  options.threshold_hu = workup.segmentation()->threshold_hu;
  options.calibration.threshold_hu = options.threshold_hu;
  options.upsample = upsample;
  return options;
}

void check_size(const VoxelWindow& window, int upsample) {
  const double n = upsample, voxels = window.dims.cast<double>().prod() * n * n * n;
  if (voxels > max_grid_voxels)
    throw Error(ErrorKind::invalid_input, "upsampling by " + std::to_string(upsample) +
                                              " makes more than 1.5e9 voxels; take a smaller factor or only "
                                              "the region around the glenoid");
}

/// About the glenoid: the joint to the lateral side, the vault to the medial one, and the rim with room for a
/// reamer of 44 mm.
Aabb glenoid_roi_mm(const Vec3& centre, case_::Side side) {
  constexpr double lateral_mm = 18.0, medial_mm = 42.0, across_mm = 34.0;
  const double low = side == case_::Side::right ? lateral_mm : medial_mm;
  const double high = side == case_::Side::right ? medial_mm : lateral_mm;
  return {centre - Vec3(low, across_mm, across_mm), centre + Vec3(high, across_mm, across_mm)};
}

Aabb roi_for(const Workup& workup, const case_::Landmarks& landmarks, const BuildSettings& settings) {
  const BonePart& scapula = scapula_part(workup);
  if (!settings.around_glenoid) return {scapula.low_mm, scapula.high_mm};
  if (!landmarks.glenoid_centre_mm)
    throw Error(ErrorKind::conflict, "case '" + workup.id +
                                         "' has no glenoid centre yet; place that landmark, or build the "
                                         "whole scapula");
  return glenoid_roi_mm(*landmarks.glenoid_centre_mm, workup.side);
}

/// The glenoid's own frame where enough landmarks are placed.
std::optional<case_::GlenoidFrame> frame_of(const case_::Landmarks& landmarks, case_::Side side) {
  const bool whole = landmarks.glenoid_centre_mm && landmarks.superior_rim_mm && landmarks.inferior_rim_mm &&
                     landmarks.anterior_rim_mm && landmarks.posterior_rim_mm;
  if (!whole) return std::nullopt;
  return case_::glenoid_frame(landmarks, side);
}

}  // namespace

voxel::BoneModel scapula_of(const Workup& workup, const std::vector<int16_t>& hu,
                            const std::vector<uint8_t>& labels) {
  const BonePart& part = scapula_part(workup);
  const ScapulaPart scapula =
      cut(workup, hu, labels, window_of(workup.volume, {part.low_mm, part.high_mm}, 1));
  return bone_from_mask(scapula.volume, scapula.mask, options_for(workup, 1));
}

case_::Case build_from(Workup& workup, const std::vector<int16_t>& hu, const std::vector<uint8_t>& labels,
                       const case_::Landmarks& landmarks, const BuildSettings& settings,
                       const Progress& progress) {
  const Aabb roi = roi_for(workup, landmarks, settings);
  const VoxelWindow window = window_of(workup.volume, roi, settings.around_glenoid ? 0 : 1);
  check_size(window, settings.upsample);
  progress(0.05, "cutting out the scapula");
  ScapulaPart scapula = cut(workup, hu, labels, window);
  case_::Case result;
  result.id = workup.id;
  result.name = workup.name;
  result.source = workup.volume.source;
  result.side = workup.side;
  result.warnings = workup.volume.warnings;
  const auto& said = workup.segmentation()->warnings;
  result.warnings.insert(result.warnings.end(), said.begin(), said.end());
  const SegmentationOptions options = options_for(workup, settings.upsample);
  result.calibration = options.calibration;
  result.glenoid = frame_of(landmarks, workup.side);
  progress(0.1, "upsampling");
  result.bone = bone_from_mask(scapula.volume, std::move(scapula.mask), options);
  if (settings.cartilage_mm > 0.0) {
    progress(0.8, "laying cartilage on the face");
    if (!result.glenoid)
      throw Error(ErrorKind::conflict, "case '" + workup.id +
                                           "' needs the glenoid centre and the four rim points before "
                                           "cartilage can be laid on its face");
  }
  workup.built = BuildRecord{settings, roi, result.bone.filled_voxels(), workup.segmentation()->revision};
  return result;
}

}  // namespace ream::ct
