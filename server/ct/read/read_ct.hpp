#pragma once
#include <cstdint>
#include <filesystem>

#include "core/progress.hpp"
#include "ct/hu_volume.hpp"

namespace ream::ct {

/// The way in for files of others. They are read by ream-reader (server/reader), in a process of its own.
/// GrayVolume (gray_volume.hpp) reads values that need not be HU.

struct ReadOptions {
  std::string series_uid;   ///< of several DICOM series the one with this UID; empty: the one of most slices
  bool keep_names = false;  ///< keep the patient's name and id, and a volume file's name in `source`
  uint64_t max_bytes =
      uint64_t{4} << 30;  ///< of the volume: two a voxel; more is refused before memory is taken
  std::filesystem::path scratch =
      {};  ///< folder for what is unpacked; empty: the system's for temporary files
  std::filesystem::path reader =
      {};  ///< the program that reads; empty: ream-reader, beside the one that runs
};

/// Reads a CT: a folder of DICOM slices (or one DICOM file of many), one NRRD, NIfTI or MetaImage file (.nrrd
/// .nhdr .nii .nii.gz .mha .mhd) of any integer or float voxels and any orthogonal orientation, a text file
/// of rows `x y z gray` (reader/ct_files.hpp), or a zip archive of one of these. World is LPS mm whatever the
/// file's own convention; a left-handed volume is turned right-handed by reversing its last axis. Values
/// below min_hu become min_hu. What was odd or repaired is in `warnings`, in plain words. A file's claims are
/// held against its size before memory is taken, and a CT has at most max_ct_voxels. Errors: not_found,
/// invalid_input (names the file and the reason), cancelled by `progress`; one line each.
HuVolume read_ct(const std::filesystem::path& path, const ReadOptions& options = {},
                 const Progress& progress = no_progress);

inline constexpr double max_ct_voxels = 1.0e9;  ///< 2 GB of HU; a clinical CT has up to 5e8

/// One NRRD, NIfTI or MetaImage file, values clamped to 16 bits but otherwise as they are (label maps).
HuVolume read_volume_file(const std::filesystem::path& path);

}  // namespace ream::ct
