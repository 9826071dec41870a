#pragma once
#include <filesystem>
#include <string>

namespace ream {

/// Where cases and sessions live: `chosen` (--data) if not empty, else REAM_DATA, else ~/.local/share/ream.
/// Not created.
std::filesystem::path data_folder(const std::filesystem::path& chosen);

/// Creates it, for its owner alone, and proves that files can be written there. Error io.
void make_data_folder(const std::filesystem::path& data);
/// What to do about a data folder that other users of this machine can read; empty where none can.
std::string data_folder_warning(const std::filesystem::path& data);
/// From here on what this program makes is for its owner alone, as what lies in the data folder should be.
void restrict_new_files_to_owner() noexcept;

std::filesystem::path cases_folder(const std::filesystem::path& data);
std::filesystem::path sessions_folder(const std::filesystem::path& data);
/// Held (core/file_lock.hpp) while a server runs on the data folder.
std::filesystem::path serving_lock(const std::filesystem::path& data);
std::filesystem::path rubrics_folder(const std::filesystem::path& data);
std::filesystem::path benchmarks_folder(const std::filesystem::path& data);

/// Folder of a case given on the command line: a bare name is looked up in the data folder's cases, anything
/// with a slash is a path.
std::filesystem::path case_path(const std::string& name, const std::filesystem::path& data);

}  // namespace ream
