#include "ct/build/ct_workspace.hpp"

#include <algorithm>

#include "case/measures.hpp"
#include "core/error.hpp"
#include "ct/build/bone_from_mask.hpp"
#include "ct/build/cartilage.hpp"

namespace ream::ct {
namespace {

Error no_scapula(const Workup& workup) {
  return {ErrorKind::conflict,
          "case '" + workup.id + "' has no segmented scapula; segment it again with a seed in the scapula"};
}

Mask scapula_mask(const Workup& workup, const std::vector<uint8_t>& labels) {
  Mask mask = mask_of(labels, BoneLabel::scapula);
  if (count_set(mask) == 0) throw no_scapula(workup);
  return mask;
}

HuVolume volume_of(const Workup& workup, const std::vector<int16_t>& hu) {
  HuVolume volume = workup.volume;
  volume.hu = hu;
  return volume;
}

case_::Calibration calibration_of(const Workup& workup, const BuildSettings& settings) {
  case_::Calibration calibration = settings.calibration;
  calibration.threshold_hu = workup.segmentation()->threshold_hu;
  return calibration;
}

/// Without a trigonum, the joint faces the patient's side.
Vec3 lateral_of(const case_::Landmarks& landmarks, case_::Side side) {
  if (landmarks.trigonum_mm) return *landmarks.glenoid_centre_mm - *landmarks.trigonum_mm;
  return side == case_::Side::right ? Vec3(-Vec3::UnitX()) : Vec3(Vec3::UnitX());
}

std::optional<Aabb> roi_for(const Workup& workup, const case_::Landmarks& landmarks,
                            const BuildSettings& settings) {
  if (!settings.around_glenoid) return std::nullopt;
  if (!landmarks.glenoid_centre_mm)
    throw Error(ErrorKind::conflict, "case '" + workup.id +
                                         "' has no glenoid centre yet; place that landmark, or build the "
                                         "whole scapula");
  return glenoid_roi_mm(*landmarks.glenoid_centre_mm, lateral_of(landmarks, workup.side));
}

Aabb box_of(const voxel::VoxelGrid& grid) {
  const Vec3 size = (grid.dims.cast<double>().array() * grid.spacing_mm.array()).matrix();
  return Aabb{Vec3::Zero(), size}.transformed(grid.world_from_grid);
}

/// The glenoid's own frame where enough landmarks are placed.
std::optional<case_::GlenoidFrame> frame_of(const case_::Landmarks& landmarks, case_::Side side) {
  const bool whole = landmarks.glenoid_centre_mm && landmarks.superior_rim_mm && landmarks.inferior_rim_mm &&
                     landmarks.anterior_rim_mm && landmarks.posterior_rim_mm;
  if (!whole) return std::nullopt;
  return case_::glenoid_frame(landmarks, side);
}

CartilageSettings cartilage_of(const BuildSettings& settings) {
  CartilageSettings cartilage;
  cartilage.thickness_mm = settings.cartilage_mm;
  return cartilage;
}

}  // namespace

voxel::BoneModel scapula_of(const Workup& workup, const std::vector<int16_t>& hu,
                            const std::vector<uint8_t>& labels) {
  if (!workup.segmentation()) throw no_scapula(workup);
  return bone_from_mask(volume_of(workup, hu), scapula_mask(workup, labels),
                        BoneSettings{std::nullopt, 1, calibration_of(workup, {})}, no_progress);
}

case_::Case build_from(Workup& workup, const std::vector<int16_t>& hu, const std::vector<uint8_t>& labels,
                       const case_::Landmarks& landmarks, const BuildSettings& settings,
                       const Progress& progress) {
  if (!workup.segmentation()) throw no_scapula(workup);
  case_::Case result;
  result.glenoid = frame_of(landmarks, workup.side);
  if (settings.cartilage_mm > 0.0 && !result.glenoid)
    throw Error(ErrorKind::conflict, "case '" + workup.id +
                                         "' needs the glenoid centre and the four rim points before "
                                         "cartilage can be laid on its face");
  const std::optional<Aabb> roi = roi_for(workup, landmarks, settings);
  result.id = workup.id;
  result.name = workup.name;
  result.source = workup.volume.source;
  result.side = workup.side;
  result.warnings = workup.volume.warnings;
  const auto& said = workup.segmentation()->warnings;
  result.warnings.insert(result.warnings.end(), said.begin(), said.end());
  result.calibration = calibration_of(workup, settings);
  result.bone = bone_from_mask(volume_of(workup, hu), scapula_mask(workup, labels),
                               BoneSettings{roi, settings.upsample, result.calibration}, progress);
  if (settings.cartilage_mm > 0.0) add_cartilage(result.bone, *result.glenoid, cartilage_of(settings));
  workup.built = build_record(result.bone, settings, workup.segmentation()->revision);
  return result;
}

BuildRecord build_record(const voxel::BoneModel& bone, const BuildSettings& settings,
                         int segmentation_revision) {
  return {settings, box_of(bone.grid), bone.filled_voxels(), density_range_g_cc(bone), segmentation_revision};
}

}  // namespace ream::ct
