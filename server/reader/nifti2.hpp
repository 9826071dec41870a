#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

namespace ream::reader {

/// Of NIfTI-2 (nifti2.h), which the library does not read: the same in NIfTI-1, whose fields are narrower.
inline constexpr size_t nifti1_header_bytes = 348, nifti1_voxels_begin = 352, nifti2_header_bytes = 540;

/// Where the voxels of a NIfTI-2 file begin, and what stands before them in the NIfTI-1 file of that content,
/// in the byte order of the given header.
struct Nifti1Header {
  uint64_t voxels_begin = 0;
  std::string bytes;
};

/// Takes the first nifti2_header_bytes of a file. Throws Error invalid_input naming `place` for what NIfTI-1
/// has no room for: more than 32,767 voxels along an axis.
Nifti1Header nifti1_of(const std::string& header, bool swapped, const std::string& place);

/// Writes the header and `voxel_bytes` of the file's voxels, unpacked where they are packed. Returns the new
/// file, in the working folder. Errors: invalid_input where there are fewer; io.
std::filesystem::path write_as_nifti1(const std::filesystem::path& path, const Nifti1Header& header,
                                      uint64_t voxel_bytes);

}  // namespace ream::reader
