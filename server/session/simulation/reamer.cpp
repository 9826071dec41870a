#include "session/simulation/reamer.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/file.hpp"
#include "shell/parametric_profile.hpp"
#include "shell/reamer_library.hpp"

namespace ream::session {
namespace {

namespace fs = std::filesystem;

/// A folder in the system's place for temporary things; removed with all that is in it.
class SystemTemporaryFolder {
 public:
  SystemTemporaryFolder() {
    std::string pattern = (fs::temp_directory_path() / "ream-reamer-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr)
      throw Error(ErrorKind::io,
                  "cannot make a folder for a reamer's mesh in " + fs::temp_directory_path().string());
    path_ = pattern;
  }
  ~SystemTemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  SystemTemporaryFolder(const SystemTemporaryFolder&) = delete;
  SystemTemporaryFolder& operator=(const SystemTemporaryFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

}  // namespace

Reamer reamer_asked_for(const std::string& words, const std::optional<shell::ToolAxis>& axis) {
  std::error_code failed;
  if (shell::is_parametric(words) || !fs::is_regular_file(words, failed)) return {words, std::nullopt};
  return {words, axis ? axis : shell::axis_noted_for(words), read_binary_file(words)};
}

std::string reamer_in_library(const std::string& build_setup, const fs::path& data) {
  std::error_code failed;
  const bool bare_name = !build_setup.empty() && build_setup.find_first_of(" ./\\") == std::string::npos &&
                         !shell::is_parametric(build_setup) && !fs::is_regular_file(build_setup, failed);
  return bare_name ? shell::reamer_named(build_setup, data).words : build_setup;
}

shell::Tool tool_of(const Reamer& reamer) {
  if (reamer.mesh_file.empty()) return shell::make_tool(reamer.words, reamer.axis);
  const SystemTemporaryFolder folder;
  const fs::path file = folder.path() / ("reamer" + fs::path(reamer.words).extension().string());
  write_file_atomically(file, std::span<const std::byte>(reamer.mesh_file));
  try {
    shell::Tool tool = shell::make_tool(file.string(), reamer.axis);
    tool.name = reamer.words;
    return tool;
  } catch (const Error& e) {
    throw Error(e.kind(),
                "the reamer '" + reamer.words + "' cannot be made again from its recorded mesh: " + e.what());
  }
}

std::string axis_to_text(const std::optional<shell::ToolAxis>& axis) {
  if (!axis) return "";
  const Vec3 &p = axis->point_mm, &d = axis->direction;
  return nlohmann::json{p.x(), p.y(), p.z(), d.x(), d.y(), d.z()}.dump();
}

std::optional<shell::ToolAxis> axis_from_text(const std::string& text, const std::string& place) {
  if (text.empty()) return std::nullopt;
  const nlohmann::json list = nlohmann::json::parse(text, nullptr, false);
  const bool six = list.is_array() && list.size() == 6;
  if (!six || !std::all_of(list.begin(), list.end(), [](const auto& n) { return n.is_number(); }))
    throw Error(ErrorKind::invalid_input, place + ": the reamer's axis must be six numbers");
  const auto v = list.get<std::vector<double>>();
  return shell::ToolAxis{Vec3(v[0], v[1], v[2]), Vec3(v[3], v[4], v[5])};
}

}  // namespace ream::session
