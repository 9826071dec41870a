#pragma once
#include <filesystem>
#include <string>

namespace ream::ct {

/// What a file should hold, by the ending of its name in any case.
enum class CtFileKind {
  volume,   ///< NRRD, NIfTI or MetaImage
  rows,     ///< text rows x y z gray
  dicom,    ///< .dcm; DICOM files have other names or none, too
  archive,  ///< of whatever kind; only zip can be read
  unknown,
};
CtFileKind kind_by_name(const std::filesystem::path& path);

/// The ending in small letters, ".nii.gz" whole; empty where there is none.
std::string ct_file_ending(const std::filesystem::path& path);

/// Whether the header of such a file names the file with the voxels, which lies beside it.
bool names_another_file(const std::filesystem::path& path);

}  // namespace ream::ct
