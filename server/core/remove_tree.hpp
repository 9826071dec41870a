#pragma once
#include <filesystem>

namespace ream {

/// Removes a file, or a folder with all that lies below it, however deep and whatever its permissions are;
/// links are removed, not followed. Holds two descriptors at most, where std::filesystem::remove_all has one
/// for each level open. Nobody else may change the folder meanwhile. False when something is left; what was
/// not there is gone, too.
bool remove_tree(const std::filesystem::path& path) noexcept;

}  // namespace ream
