#include "session/folder/black_box_files.hpp"

#include <algorithm>
#include <charconv>
#include <optional>

#include "core/folder_listing.hpp"

namespace ream::session {
namespace fs = std::filesystem;
namespace {

const std::string prefix = "black-box-", suffix = ".csv";

/// The tick in the name of a black box; empty for other files.
std::optional<uint32_t> tick_of(const fs::path& path) {
  const std::string name = path.filename().string();
  if (!name.starts_with(prefix) || !name.ends_with(suffix) || name.size() <= prefix.size() + suffix.size())
    return std::nullopt;
  uint32_t tick = 0;
  const char *begin = name.data() + prefix.size(), *end = name.data() + name.size() - suffix.size();
  const auto [read, failed] = std::from_chars(begin, end, tick);
  if (failed != std::errc{} || read != end) return std::nullopt;
  return tick;
}

}  // namespace

std::vector<fs::path> black_boxes_in(const fs::path& folder) {
  std::vector<fs::path> found;
  for (const fs::path& path : paths_in(folder))
    if (tick_of(path)) found.push_back(path);
  std::sort(found.begin(), found.end(),
            [](const fs::path& a, const fs::path& b) { return *tick_of(a) < *tick_of(b); });
  return found;
}

fs::path write_black_box(const sim::BlackBox& box, const fs::path& folder, uint32_t tick) {
  const fs::path path = folder / (prefix + std::to_string(tick) + suffix);
  box.write(path);
  std::vector<fs::path> boxes = black_boxes_in(folder);
  std::error_code ignored;
  for (size_t i = 0; i + max_black_boxes < boxes.size(); ++i) fs::remove(boxes[i], ignored);
  return path;
}

}  // namespace ream::session
