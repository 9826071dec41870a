#pragma once
#include <filesystem>

namespace ream::app {

/// Where cases and sessions live: `chosen` (--data) if not empty, else REAM_DATA, else ~/.local/share/ream.
/// Not created.
std::filesystem::path data_folder(const std::filesystem::path& chosen);

std::filesystem::path cases_folder(const std::filesystem::path& data);
std::filesystem::path sessions_folder(const std::filesystem::path& data);
std::filesystem::path rubrics_folder(const std::filesystem::path& data);

}  // namespace ream::app
