#include "ct/build/import.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "ct/build/cartilage.hpp"
#include "ct/build/ct_workspace.hpp"
#include "ct/read/read_ct.hpp"
#include "ct/read/write_volume.hpp"
#include "ct/segment/label_map.hpp"

namespace ream::ct {
namespace {

constexpr double max_grid_voxels = 1.5e9;  // more than 3 GB of density and coverage

void check_grid_size(const HuVolume& volume, int upsample) {
  const double n = upsample;
  if (static_cast<double>(volume.voxel_count()) * n * n * n > max_grid_voxels)
    throw Error(ErrorKind::invalid_input,
                "upsampling by " + std::to_string(upsample) +
                    " makes more than 1.5e9 voxels; choose a smaller --roi or --upsample");
}

Segmentation labelled(HuVolume& volume, const ImportOptions& options, case_::Side side,
                      const Progress& progress) {
  if (options.label) {
    const HuVolume label = read_volume_file(*options.label);
    smooth(volume, options.segmentation.sigma_mm);
    LabelValues values;
    values.scapula = options.label_value;
    return segmentation_from_labels(volume, label, values);
  }
  SegmentationSettings settings = *options.shoulder;
  settings.side = side;
  return segment_shoulder(volume, settings, progress);
}

Vec3 glenoid_centre(const ImportOptions& options, const Segmentation& segmentation) {
  if (options.glenoid_mm) return *options.glenoid_mm;
  if (segmentation.glenoid_mm) return *segmentation.glenoid_mm;
  throw Error(ErrorKind::invalid_input,
              "where the glenoid is was not found; give its centre with --glenoid X,Y,Z (LPS mm)");
}

/// Lateral towards the head, or straight to the side without one; superior as near to world z as may be.
case_::GlenoidFrame glenoid_frame(const Vec3& centre_mm, const Segmentation& segmentation, case_::Side side) {
  const double lateral_x = side == case_::Side::right ? -1.0 : 1.0;
  case_::GlenoidFrame frame;
  frame.centre_mm = centre_mm;
  frame.lateral = segmentation.head ? (segmentation.head->centre_mm - centre_mm).normalized()
                                    : Vec3(lateral_x * 0.8, -0.6, 0.0);
  const Vec3 across = Vec3::UnitZ().cross(frame.lateral).normalized();
  frame.superior = frame.lateral.cross(across);
  frame.anterior = across.y() < 0.0 ? across : Vec3(-across);
  return frame;
}

Segmentation make_from_labels(HuVolume& volume, const ImportOptions& options, case_::Case& result,
                              const Progress& progress) {
  if (options.roi_mm) cropped(volume, *options.roi_mm);  // refuses a region outside before the long work
  Segmentation segmentation = labelled(volume, options, result.side, part_of(progress, 0.3, 0.7));
  result.calibration.threshold_hu = segmentation.threshold_hu;
  result.warnings.insert(result.warnings.end(), segmentation.warnings.begin(), segmentation.warnings.end());
  if (options.labels_out) write_label_map(volume, segmentation.labels, *options.labels_out);
  const Vec3 to_head = Vec3(result.side == case_::Side::right ? -0.8 : 0.8, -0.6, 0.0);
  BoneSettings settings;
  settings.upsample = options.segmentation.upsample;
  settings.calibration = result.calibration;
  settings.roi_mm = options.roi_mm;
  if (options.roi_at_glenoid)
    settings.roi_mm = glenoid_roi_mm(glenoid_centre(options, segmentation), to_head);
  result.bone = bone_from_mask(volume, mask_of(segmentation.labels, BoneLabel::scapula), settings,
                               part_of(progress, 0.7, 0.95));
  if (options.cartilage_mm == 0.0) return segmentation;
  progress(0.95, "laying cartilage");
  CartilageSettings cartilage;
  cartilage.thickness_mm = options.cartilage_mm;
  add_cartilage(result.bone, glenoid_frame(glenoid_centre(options, segmentation), segmentation, result.side),
                cartilage);
  return segmentation;
}

void make_from_growing(HuVolume& volume, const ImportOptions& options, case_::Case& result) {
  if (options.roi_at_glenoid || options.cartilage_mm > 0.0)
    throw Error(ErrorKind::invalid_input,
                "a region around the glenoid and cartilage need a segmented shoulder or a label map");
  if (options.roi_mm) volume = cropped(volume, *options.roi_mm);
  check_grid_size(volume, options.segmentation.upsample);
  Mask mask = segment(volume, options.segmentation);
  result.bone = bone_from_mask(volume, std::move(mask), options.segmentation);
}

}  // namespace

Mask mask_from_label(const HuVolume& volume, const HuVolume& label, int value) {
  Mask mask(volume.voxel_count());
  const Pose label_from_volume = label.world_from_volume.inverse() * volume.world_from_volume;
  bool any = false;
  for (int w = 0; w < volume.dims.z(); ++w)
    for (int v = 0; v < volume.dims.y(); ++v)
      for (int u = 0; u < volume.dims.x(); ++u) {
        const Vec3 centre = (Vec3(u + 0.5, v + 0.5, w + 0.5).array() * volume.spacing_mm.array()).matrix();
        const Vec3 p = label_from_volume.point(centre);
        const Vec3i o = (p.array() / label.spacing_mm.array()).floor().cast<int>().matrix();
        if (!label.contains(o) || label.hu[label.index(o.x(), o.y(), o.z())] != value) continue;
        mask[volume.index(u, v, w)] = 1;
        any = true;
      }
  if (!any)
    throw Error(ErrorKind::invalid_input,
                "the label map " + label.source + " holds no voxel of value " + std::to_string(value) +
                    " within the CT's region; check --label, --label-value and --roi");
  return mask;
}

Imported import_with_ct(const std::filesystem::path& path, const std::string& id,
                        const ImportOptions& options, const Progress& progress) {
  Imported imported;
  ReadOptions reading;
  reading.series_uid = options.series_uid;
  reading.keep_names = options.keep_names;
  imported.volume = read_ct(path, reading, part_of(progress, 0.0, 0.3));
  HuVolume& volume = imported.volume;
  case_::Case& result = imported.made;
  result.id = id;
  result.name = id;
  if (volume.patient) result.name = volume.patient->name + " (" + volume.patient->id + ")";
  result.source = volume.source;
  result.side = options.side.value_or(case_::Side::right);
  result.warnings = volume.warnings;
  if (!options.side) result.warnings.push_back("no --side was given; the case is marked as a right shoulder");
  result.calibration = options.segmentation.calibration;
  result.calibration.threshold_hu = options.segmentation.threshold_hu;
  if (options.shoulder || options.label)
    imported.segmentation = make_from_labels(volume, options, result, progress);
  else
    make_from_growing(volume, options, result);
  if (result.bone.filled_voxels() == 0)
    throw Error(ErrorKind::invalid_input,
                "the segmentation holds no bone that fills half a voxel; choose another --threshold-hu or "
                "--upsample");
  progress(1.0, "case ready");
  return imported;
}

case_::Case import_ct(const std::filesystem::path& path, const std::string& id, const ImportOptions& options,
                      const Progress& progress) {
  return import_with_ct(path, id, options, progress).made;
}

void save_imported(const Imported& imported, const ImportOptions& options,
                   const std::filesystem::path& folder, bool replace) {
  const case_::Case& made = imported.made;
  if (!imported.segmentation) return case_::save_case(made, folder, replace);
  AtomicFolder target(folder, replace);
  Workup workup = write_workup(target.path(), made.id, made.name, made.side, imported.volume);
  SegmentationSettings settings = options.shoulder.value_or(SegmentationSettings{});
  settings.side = made.side;
  add_segmentation(target.path(), workup, settings, *imported.segmentation);
  const BuildSettings build{options.segmentation.upsample, options.roi_at_glenoid || options.roi_mm,
                            options.cartilage_mm, made.calibration};
  workup.built = build_record(made.bone, build, workup.segmentation()->revision);
  save_workup(target.path(), workup);
  case_::save_bone(made, target.path());
  if (made.plan) case_::save_plan(*made.plan, target.path());
  if (imported.landmarks) case_::save_landmarks(*imported.landmarks, target.path());
  target.commit();
}

std::string case_id_from(const std::filesystem::path& folder) {
  std::filesystem::path named = std::filesystem::absolute(folder).lexically_normal();
  if (!named.has_filename()) named = named.parent_path();
  std::string id;
  for (const char c : named.filename().string()) {
    const bool upper = c >= 'A' && c <= 'Z', kept = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
    if (upper)
      id += static_cast<char>(c - 'A' + 'a');
    else if (kept)
      id += c;
    else if (!id.empty() && id.back() != '-')
      id += '-';
  }
  while (!id.empty() && id.back() == '-') id.pop_back();
  return id.empty() ? "case" : id;
}

}  // namespace ream::ct
