#include "ct/nrrd_order.hpp"

#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace ream::ct {
namespace fs = std::filesystem;
namespace {

constexpr size_t max_lines = 1000, max_line_bytes = 1 << 16;

bool names_space(const std::string& line) {
  return line.starts_with("space:") || line.starts_with("space dimension:");
}

bool needs_space(const std::string& line) {
  return line.starts_with("space directions:") || line.starts_with("space origin:") ||
         line.starts_with("space units:") || line.starts_with("measurement frame:");
}

/// Lines up to the empty one, without it.
std::vector<std::string> header_lines(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::vector<std::string> lines;
  for (std::string line; lines.size() < max_lines && std::getline(in, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.empty() || line.size() > max_line_bytes) break;
    lines.push_back(line);
  }
  return lines;
}

}  // namespace

OrderedNrrd::OrderedNrrd(const fs::path& path) : path_(path) {
  auto lines = header_lines(path);
  if (lines.empty() || !lines.front().starts_with("NRRD")) return;
  const auto space = std::find_if(lines.begin(), lines.end(), names_space);
  const auto first_need = std::find_if(lines.begin(), lines.end(), needs_space);
  if (space == lines.end() || first_need >= space) return;
  const size_t before_voxels = lines.size() + 1;
  bool elsewhere = false;
  for (std::string& line : lines)
    for (const std::string key : {"data file:", "datafile:"})
      if (line.starts_with(key)) {
        const size_t name = line.find_first_not_of(' ', key.size());
        line = "data file: " +
               (fs::absolute(path).parent_path() / line.substr(std::min(name, line.size()))).string();
        elsewhere = true;
      }
  std::stable_partition(lines.begin() + 1, lines.end(), [](const std::string& line) {
    return line.starts_with("dimension:") || names_space(line);
  });
  // A data file ends the header, so it comes last.
  std::stable_partition(lines.begin(), lines.end(),
                        [](const std::string& line) { return !line.starts_with("data file:"); });
  if (!elsewhere) {
    lines.push_back("line skip: " + std::to_string(before_voxels));
    lines.push_back("data file: " + fs::absolute(path).string());
  }
  std::string name = (fs::temp_directory_path() / "ream-XXXXXX.nhdr").string();
  constexpr int ending_bytes = 5;
  const int file = ::mkstemps(name.data(), ending_bytes);
  if (file < 0) throw Error(ErrorKind::io, "cannot write " + name);
  ::close(file);
  path_ = name;
  passing_ = true;
  std::ofstream out(path_, std::ios::binary);
  for (const std::string& line : lines) out << line << '\n';
  if (!out.flush()) {
    std::error_code ignored;
    fs::remove(path_, ignored);
    throw Error(ErrorKind::io, "cannot write " + name);
  }
}

OrderedNrrd::~OrderedNrrd() {
  std::error_code ignored;
  if (passing_) fs::remove(path_, ignored);
}

}  // namespace ream::ct
