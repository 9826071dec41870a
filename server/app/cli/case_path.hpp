#pragma once
#include <filesystem>
#include <string>

namespace ream::app {

/// Folder of a case given on the command line: a bare name is looked up in the data folder's cases, anything
/// with a slash is a path.
std::filesystem::path case_path(const std::string& name, const std::filesystem::path& data);

}  // namespace ream::app
