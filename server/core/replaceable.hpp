#pragma once
#include <filesystem>

namespace ream {

/// Error io where a folder, a device or a pipe stands: a file takes the place of files only.
void require_replaceable(const std::filesystem::path& path);

}  // namespace ream
