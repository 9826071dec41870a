#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace ream::bench {

/// Runs a command of the shell and reads the JSON that it prints. Error unavailable, with `needs` (what the
/// command takes to run), when it fails.
nlohmann::json script_figures(const std::string& command, const std::string& needs);

/// As a word of the shell.
std::string shell_word(const std::filesystem::path& path);

}  // namespace ream::bench
