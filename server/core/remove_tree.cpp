#include "core/temporary_file.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/file_descriptor.hpp"

namespace ream {
namespace {

struct CloseFolder {
  void operator()(DIR* folder) const { ::closedir(folder); }
};

constexpr int as_folder = O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC;

/// Its owner may have taken his own rights away.
FileDescriptor opened(int parent, const char* name) {
  FileDescriptor folder(::openat(parent, name, as_folder));
  if (!folder && errno == EACCES && ::fchmodat(parent, name, S_IRWXU, 0) == 0)
    folder = FileDescriptor(::openat(parent, name, as_folder));
  if (folder && ::fchmod(folder.get(), S_IRWXU) != 0) return {};
  return folder;
}

/// Empties the folder of all but folders that hold something, whose names it returns; nothing when something
/// else is left.
std::optional<std::vector<std::string>> empty_but_folders(const FileDescriptor& folder) {
  const int copy = ::openat(folder.get(), ".", as_folder);
  const std::unique_ptr<DIR, CloseFolder> entries(copy < 0 ? nullptr : ::fdopendir(copy));
  if (!entries) return std::nullopt;
  std::vector<std::string> full;
  while (const dirent* entry = ::readdir(entries.get())) {
    const char* name = entry->d_name;
    if (std::strcmp(name, ".") == 0 || std::strcmp(name, "..") == 0) continue;
    if (::unlinkat(folder.get(), name, 0) == 0) continue;
    if (errno != EISDIR && errno != EPERM) return std::nullopt;
    if (::unlinkat(folder.get(), name, AT_REMOVEDIR) == 0) continue;
    if (errno != ENOTEMPTY && errno != EEXIST) return std::nullopt;
    full.emplace_back(name);
  }
  return full;
}

/// Goes down into full folders and up again when they are empty; only names are kept of the way.
bool empty_folder(FileDescriptor folder) {
  struct Level {
    std::string name;
    std::vector<std::string> full;  ///< folders in it that are still to be emptied
  };
  std::vector<Level> way;
  std::string name;
  for (;;) {
    auto full = empty_but_folders(folder);
    if (!full) return false;
    way.push_back({std::move(name), std::move(*full)});
    while (way.back().full.empty()) {
      const std::string emptied = std::move(way.back().name);
      way.pop_back();
      if (way.empty()) return true;
      folder = FileDescriptor(::openat(folder.get(), "..", as_folder));
      if (!folder || ::unlinkat(folder.get(), emptied.c_str(), AT_REMOVEDIR) != 0) return false;
    }
    name = std::move(way.back().full.back());
    way.back().full.pop_back();
    folder = opened(folder.get(), name.c_str());
    if (!folder) return false;
  }
}

}  // namespace

bool remove_tree(const std::filesystem::path& path) noexcept try {
  const char* name = path.c_str();
  struct stat status {};
  if (::fstatat(AT_FDCWD, name, &status, AT_SYMLINK_NOFOLLOW) != 0) return errno == ENOENT;
  if (!S_ISDIR(status.st_mode)) return ::unlink(name) == 0;
  if (::rmdir(name) == 0) return true;
  FileDescriptor folder = opened(AT_FDCWD, name);
  return folder && empty_folder(std::move(folder)) && ::rmdir(name) == 0;
} catch (const std::bad_alloc&) {
  return false;
}

}  // namespace ream
