#include "ct/build/ct_workspace.hpp"

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

/// Towards the joint where nothing better is known: to the patient's side and front.
Vec3 default_lateral(case_::Side side) { return {side == case_::Side::right ? -0.8 : 0.8, -0.6, 0.0}; }

std::optional<Aabb> roi_for(const Workup& workup, const GlenoidPlace& glenoid,
                            const BuildSettings& settings) {
  if (settings.roi_mm || !settings.around_glenoid) return settings.roi_mm;
  if (!glenoid.centre_mm)
    throw Error(ErrorKind::conflict, "case '" + workup.id +
                                         "' has no glenoid centre yet; place that landmark, or build the "
                                         "whole scapula");
  return glenoid_roi_mm(*glenoid.centre_mm, glenoid.lateral);
}

Aabb box_of(const voxel::VoxelGrid& grid) {
  const Vec3 size = (grid.dims.cast<double>().array() * grid.spacing_mm.array()).matrix();
  return Aabb{Vec3::Zero(), size}.transformed(grid.world_from_grid);
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

GlenoidPlace glenoid_place(const case_::Landmarks& landmarks, case_::Side side) {
  GlenoidPlace place{landmarks.glenoid_centre_mm, default_lateral(side), std::nullopt};
  if (place.centre_mm && landmarks.trigonum_mm) place.lateral = *place.centre_mm - *landmarks.trigonum_mm;
  const bool whole = place.centre_mm && landmarks.superior_rim_mm && landmarks.inferior_rim_mm &&
                     landmarks.anterior_rim_mm && landmarks.posterior_rim_mm;
  if (whole) place.face = case_::glenoid_frame(landmarks, side);
  return place;
}

GlenoidPlace glenoid_place(const SegmentationRecord& segmentation, case_::Side side,
                           const std::optional<Vec3>& centre_mm) {
  GlenoidPlace place{centre_mm ? centre_mm : segmentation.glenoid_mm, default_lateral(side), std::nullopt};
  if (!place.centre_mm) return place;
  case_::GlenoidFrame& face = place.face.emplace();
  face.centre_mm = *place.centre_mm;
  face.lateral = segmentation.head ? (segmentation.head->centre_mm - *place.centre_mm).normalized()
                                   : default_lateral(side);
  const Vec3 across = Vec3::UnitZ().cross(face.lateral).normalized();
  face.superior = face.lateral.cross(across);  // as near to the body's axis as may be
  face.anterior = across.y() < 0.0 ? across : Vec3(-across);
  return place;
}

case_::Case build_from(Workup& workup, const std::vector<int16_t>& hu, const std::vector<uint8_t>& labels,
                       const GlenoidPlace& glenoid, const BuildSettings& settings, const Progress& progress) {
  if (!workup.segmentation()) throw no_scapula(workup);
  if (settings.cartilage_mm > 0.0 && !glenoid.face)
    throw Error(ErrorKind::conflict, "case '" + workup.id +
                                         "' needs the glenoid centre and the four rim points before "
                                         "cartilage can be laid on its face");
  const std::optional<Aabb> roi = roi_for(workup, glenoid, settings);
  case_::Case result;
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
  if (settings.cartilage_mm > 0.0) add_cartilage(result.bone, *glenoid.face, cartilage_of(settings));
  if (result.bone.filled_voxels() == 0)
    throw Error(ErrorKind::invalid_input,
                "the segmentation holds no bone that fills half a voxel; segment with another threshold or "
                "choose another upsampling");
  workup.built = build_record(result.bone, settings, workup.segmentation()->revision);
  return result;
}

case_::Case build_from(Workup& workup, const std::vector<int16_t>& hu, const std::vector<uint8_t>& labels,
                       const case_::Landmarks& landmarks, const BuildSettings& settings,
                       const Progress& progress) {
  const GlenoidPlace glenoid = glenoid_place(landmarks, workup.side);
  case_::Case made = build_from(workup, hu, labels, glenoid, settings, progress);
  made.glenoid = glenoid.face;
  return made;
}

BuildRecord build_record(const voxel::BoneModel& bone, const BuildSettings& settings,
                         int segmentation_revision) {
  return {settings, box_of(bone.grid), bone.filled_voxels(), density_range_g_cc(bone), segmentation_revision};
}

}  // namespace ream::ct
