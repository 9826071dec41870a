#pragma once
#include <filesystem>

#include "ct/build/ct_workspace.hpp"

namespace ream::ct {

struct ImportOptions {
  std::string name;                   ///< for people; empty: the patient's where kept, else the id
  std::optional<case_::Side> side;    ///< right, with a warning, when not given
  SegmentationSettings segmentation;  ///< its side is the case's
  /// A label map instead of the segmentation; any geometry, nearest voxel.
  std::optional<std::filesystem::path> label;
  int label_value = 1;  ///< of the scapula
  BuildSettings build;
  std::optional<Vec3> glenoid_mm;  ///< LPS; its centre, else the one found with the humeral head
  std::string series_uid;          ///< of several DICOM series; empty: the one of most slices
  bool keep_names = false;         ///< the patient's name and id become the case's name
  std::optional<std::filesystem::path> labels_out;  ///< label map to be written beside the case
};

/// A case with the CT it was made of.
struct Imported {
  case_::Case made;
  Workup workup;
  std::vector<int16_t> hu;
  std::vector<uint8_t> labels;                     ///< BoneLabel per voxel
  std::optional<case_::Landmarks> landmarks = {};  ///< where they are known, as in a phantom
};

/// A CT on disk to a case without plan, by the steps of the page (ct_workspace.hpp) at one go and in memory.
/// Errors: not_found, invalid_input; one line each that names what to do.
Imported import_ct(const std::filesystem::path& path, const std::string& id, const ImportOptions& options,
                   const Progress& progress = no_progress);

/// Saves case, CT, and plan and landmarks where there are any, in one folder, whole or not at all. Errors as
/// case_::save_case.
void save_imported(const Imported& imported, const std::filesystem::path& folder, bool replace);

/// A case id from a folder's name: lower case, everything else than a-z and 0-9 as one dash.
std::string case_id_from(const std::filesystem::path& folder);

}  // namespace ream::ct
