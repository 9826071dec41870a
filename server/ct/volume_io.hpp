#pragma once
#include <filesystem>

#include "ct/hu_volume.hpp"

namespace ream::ct {

/// Reads a CT: a folder of DICOM slices, or one NRRD, NIfTI or MetaImage file (.nrrd .nhdr .nii .nii.gz .mha
/// .mhd), any integer or float voxels, any orthogonal orientation. Values below min_hu become min_hu; a
/// left-handed volume is turned right-handed by reversing its last axis. What was odd is in `warnings`.
/// Errors: not_found, invalid_input (names the file), both one line.
HuVolume read_ct(const std::filesystem::path& path);

/// One NRRD, NIfTI or MetaImage file, values clamped to 16 bits but otherwise as they are (label maps).
HuVolume read_volume_file(const std::filesystem::path& path);

/// Writes HU as 16-bit NRRD, NIfTI or MetaImage by the file's extension. Not atomic: write into a folder in
/// progress. Throws Error io.
void write_volume_file(const HuVolume& volume, const std::filesystem::path& path);

/// The largest CT series under a folder, slices sorted along their normal. Single missing slices are
/// interpolated; slices of other orientations, duplicates and further series are left out: each with a
/// warning.
HuVolume read_dicom_folder(const std::filesystem::path& folder);

/// One CT slice a file, slice_0001.dcm and so on; identifiers follow from `seed` alone, so equal volumes give
/// equal series. Throws Error io.
void write_dicom_folder(const HuVolume& volume, const std::filesystem::path& folder, uint64_t seed);

}  // namespace ream::ct
