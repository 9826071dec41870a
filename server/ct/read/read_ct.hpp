#pragma once
#include <filesystem>

#include "core/progress.hpp"
#include "ct/hu_volume.hpp"

namespace ream::ct {

/// The way in for files of others: nothing else of this folder is for those who only want a CT, but for
/// GrayVolume (gray_volume.hpp), which reads values that need not be HU.

struct ReadOptions {
  std::string series_uid;   ///< of several DICOM series the one with this UID; empty: the one of most slices
  bool keep_names = false;  ///< keep the patient's name and id, and a volume file's name in `source`
};

/// Reads a CT: a folder of DICOM slices (or one DICOM file of many), one NRRD, NIfTI or MetaImage file (.nrrd
/// .nhdr .nii .nii.gz .mha .mhd) of any integer or float voxels and any orthogonal orientation, or a text
/// file of rows `x y z gray` (readers.hpp). World is LPS mm whatever the file's own convention; a
/// left-handed volume is turned right-handed by reversing its last axis. Values below min_hu become min_hu.
/// What was odd or repaired is in `warnings`, in plain words. A file's claims are held against its size
/// before memory is taken, and a CT has at most max_ct_voxels. Errors: not_found, invalid_input (names the
/// file and the reason), cancelled by `progress`; one line each.
HuVolume read_ct(const std::filesystem::path& path, const ReadOptions& options = {},
                 const Progress& progress = no_progress);

inline constexpr double max_ct_voxels = 1.0e9;  ///< 2 GB of HU; a clinical CT has up to 5e8

/// One NRRD, NIfTI or MetaImage file, values clamped to 16 bits but otherwise as they are (label maps).
HuVolume read_volume_file(const std::filesystem::path& path);

/// Whether a file is DICOM, by its content; a damaged one is.
bool is_dicom(const std::filesystem::path& file);

}  // namespace ream::ct
