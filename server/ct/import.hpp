#pragma once
#include <filesystem>

#include "ct/build_case.hpp"

namespace ream::ct {

struct ImportOptions {
  std::optional<Aabb> roi_mm;  ///< LPS; without it the whole CT
  std::optional<std::filesystem::path>
      label;  ///< label map instead of threshold and growing; any geometry, nearest voxel
  int label_value = 1;
  std::optional<case_::Side> side;  ///< right, with a warning, when not given
  SegmentationOptions segmentation;
};

/// A CT on disk to a case without plan. Errors: not_found, invalid_input; one line each that names what to
/// do.
case_::Case import_ct(const std::filesystem::path& path, const std::string& id, const ImportOptions& options);

/// Mask of the voxels whose centre lies in a voxel of that value in the label map. Throws Error invalid_input
/// when the map holds no such label within the CT.
Mask mask_from_label(const HuVolume& volume, const HuVolume& label, int value);

/// A case id from a folder's name: lower case, everything else than a-z and 0-9 as one dash.
std::string case_id_from(const std::filesystem::path& folder);

}  // namespace ream::ct
