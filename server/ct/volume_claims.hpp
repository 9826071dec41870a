#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace ream::ct {

/// Holds what the header of a NRRD, NIfTI or MetaImage file claims against what it can be, before anybody
/// takes memory for it or a library silently repairs it: whole positive numbers of voxels, at most
/// max_ct_voxels, no more than the file can hold, positive finite voxel sizes, perpendicular axes (NIfTI),
/// data in the file itself or in one beside it, axes that are known. Returns what is odd but can be used.
/// Throws Error invalid_input naming the file and the reason.
std::vector<std::string> check_claims(const std::filesystem::path& path);

}  // namespace ream::ct
