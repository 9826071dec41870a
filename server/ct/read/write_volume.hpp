#pragma once
#include <filesystem>

#include "ct/hu_volume.hpp"

namespace ream::ct {

/// Writes HU as 16-bit NRRD, NIfTI or MetaImage by the file's extension. Not atomic: write into a folder in
/// progress. Throws Error io.
void write_volume_file(const HuVolume& volume, const std::filesystem::path& path);

/// One CT slice a file, slice_0001.dcm and so on; identifiers follow from `seed` alone, so equal volumes give
/// equal series. Throws Error io.
void write_dicom_folder(const HuVolume& volume, const std::filesystem::path& folder, uint64_t seed);

/// Writes labels (BoneLabel) as an 8-bit NRRD (.nrrd) or NIfTI (.nii, .nii.gz) file with the CT's geometry.
/// Appears whole or not at all. Errors: invalid_input for another extension or labels that
/// are not one per voxel, io.
void write_label_map(const HuVolume& ct, const std::vector<uint8_t>& labels,
                     const std::filesystem::path& path);

}  // namespace ream::ct
