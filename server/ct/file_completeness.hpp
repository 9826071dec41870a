#pragma once
#include <cstdint>
#include <filesystem>

namespace ream::ct {

/// The reading library hands out zeros for what is missing in a cut-off NIfTI or MetaImage file, so what is
/// there is counted first; of a packed NRRD the checksum is checked. `image_bytes` is the size that the
/// header promises. Throws Error invalid_input naming the file. Files of other formats pass.
void check_complete(const std::filesystem::path& path, uint64_t image_bytes);

}  // namespace ream::ct
