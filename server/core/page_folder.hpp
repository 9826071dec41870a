#pragma once
#include <filesystem>

namespace ream {

/// Folder of the built page: `chosen` (--web), else share/ream/web of the place where the program is
/// installed, else web/dist of the source tree that it was built in. Empty when it is in neither of these.
/// Error not_found when `chosen` is not empty and has no page.
std::filesystem::path page_folder(const std::filesystem::path& chosen);

}  // namespace ream
