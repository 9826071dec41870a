#include "core/folder_listing.hpp"

#include <dirent.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>

#include "core/error.hpp"

namespace ream {
namespace fs = std::filesystem;
namespace {

Error cannot_read(const fs::path& folder, const std::string& why) {
  return {ErrorKind::io, "cannot read the folder " + folder.string() + ": " + why};
}

bool is_link(const fs::path& path) {
  std::error_code failed;
  return fs::is_symlink(fs::symlink_status(path, failed));
}

}  // namespace

// The standard library's iterators end the program where they get no memory.
std::vector<fs::path> paths_in(const fs::path& folder) {
  const std::unique_ptr<DIR, int (*)(DIR*)> opened(::opendir(folder.c_str()), ::closedir);
  if (!opened && errno == ENOENT) {
    if (is_link(folder)) throw cannot_read(folder, "it is a link that leads nowhere");
    return {};
  }
  if (!opened) throw cannot_read(folder, std::strerror(errno));
  std::vector<fs::path> found;
  errno = 0;
  while (const dirent* const next = ::readdir(opened.get())) {
    const std::string name = next->d_name;
    if (name != "." && name != "..") found.push_back(folder / name);
    errno = 0;
  }
  if (errno != 0) throw cannot_read(folder, std::strerror(errno));
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace ream
