#include "session/simulation/reamer.hpp"

#include <algorithm>
#include <filesystem>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/json.hpp"
#include "core/temporary_file.hpp"
#include "shell/parametric_profile.hpp"
#include "shell/reamer_library.hpp"

namespace ream::session {
namespace fs = std::filesystem;

Reamer reamer_asked_for(const std::string& words, const std::optional<shell::ToolAxis>& axis) {
  std::error_code failed;
  if (shell::is_parametric(words) || !fs::is_regular_file(words, failed)) return {words, std::nullopt};
  return {words, axis ? axis : shell::axis_noted_for(words), read_binary_file(words)};
}

std::string reamer_in_library(const std::string& reamer, const fs::path& data) {
  std::error_code failed;
  const bool bare_name = !reamer.empty() && reamer.find_first_of(" ./\\") == std::string::npos &&
                         !shell::is_parametric(reamer) && !fs::is_regular_file(reamer, failed);
  return bare_name ? shell::reamer_named(reamer, data).words : reamer;
}

shell::Tool tool_asked_for(const std::string& reamer, const fs::path& data) {
  const Reamer found = reamer_asked_for(reamer_in_library(reamer, data), std::nullopt);
  return shell::make_tool(found.words, found.axis);
}

shell::Tool tool_of(const Reamer& reamer) {
  if (reamer.mesh_file.empty()) return shell::make_tool(reamer.words, reamer.axis);
  const TemporaryFolder folder(fs::temp_directory_path() / "ream-reamer");
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
  const nlohmann::json list = parse_json_or_discard(text);
  const bool six = list.is_array() && list.size() == 6;
  if (!six || !std::all_of(list.begin(), list.end(), [](const auto& n) { return n.is_number(); }))
    throw Error(ErrorKind::invalid_input, place + ": the reamer's axis must be six numbers");
  const auto v = list.get<std::vector<double>>();
  return shell::ToolAxis{Vec3(v[0], v[1], v[2]), Vec3(v[3], v[4], v[5])};
}

}  // namespace ream::session
