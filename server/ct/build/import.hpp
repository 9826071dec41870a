#pragma once
#include <filesystem>

#include "case/landmarks.hpp"
#include "ct/build/bone_from_mask.hpp"
#include "ct/segment/shoulder_bones.hpp"

namespace ream::ct {

struct ImportOptions {
  std::optional<Aabb> roi_mm;      ///< LPS; without it the whole bone
  bool roi_at_glenoid = false;     ///< instead of roi_mm: glenoid_roi_mm about glenoid_mm
  std::optional<Vec3> glenoid_mm;  ///< LPS; its centre, else the one found with the humeral head
  /// Label map instead of threshold and growing; any geometry, nearest voxel.
  std::optional<std::filesystem::path> label;
  int label_value = 1;
  std::optional<case_::Side> side;  ///< right, with a warning, when not given
  /// Tells the bones of a shoulder apart and keeps the scapula (shoulder_bones.hpp; its side is the case's).
  /// Without it and without a label map, what grows from segmentation.grow_from_mm or the largest part.
  std::optional<SegmentationSettings> shoulder;
  SegmentationOptions segmentation;
  std::string series_uid;     ///< of several DICOM series; empty: the one of most slices
  bool keep_names = false;    ///< the patient's name and id become the case's name
  double cartilage_mm = 0.0;  ///< thickness of synthetic cartilage on the face
  std::optional<std::filesystem::path> labels_out;  ///< label map to be written beside the case
};

/// A CT on disk to a case without plan. Errors: not_found, invalid_input; one line each that names what to
/// do.
case_::Case import_ct(const std::filesystem::path& path, const std::string& id, const ImportOptions& options,
                      const Progress& progress = no_progress);

/// A case with the CT it was made of. Without a segmentation where bone only grew.
struct Imported {
  case_::Case made;
  HuVolume volume;
  std::optional<Segmentation> segmentation;
  std::optional<case_::Landmarks> landmarks = {};  ///< where they are known, as in a phantom
};
Imported import_with_ct(const std::filesystem::path& path, const std::string& id,
                        const ImportOptions& options, const Progress& progress = no_progress);

/// Saves case, CT, and plan and landmarks where there are any, in one folder (workup.hpp), whole or not at
/// all. Errors as case_::save_case.
void save_imported(const Imported& imported, const ImportOptions& options,
                   const std::filesystem::path& folder, bool replace);

/// Mask of the voxels whose centre lies in a voxel of that value in the label map. Throws Error invalid_input
/// when the map holds no such label within the CT.
Mask mask_from_label(const HuVolume& volume, const HuVolume& label, int value);

/// A case id from a folder's name: lower case, everything else than a-z and 0-9 as one dash.
std::string case_id_from(const std::filesystem::path& folder);

}  // namespace ream::ct
