#pragma once
#include <filesystem>
#include <vector>

namespace ream {

/// What lies directly in a folder, by name; nothing where there is no such folder. Error io, naming it, when
/// it cannot be read to its end, or is a link that leads nowhere: who takes what was not seen for gone loses
/// it.
std::vector<std::filesystem::path> paths_in(const std::filesystem::path& folder);

}  // namespace ream
