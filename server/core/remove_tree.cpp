#include "core/temporary_file.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "core/file_descriptor.hpp"

namespace ream {
namespace {

struct CloseFolder {
  void operator()(DIR* folder) const { ::closedir(folder); }
};

constexpr int as_folder = O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC;

/// Its owner may have taken his own rights away. Where they cannot be had back, it may be open all the same.
FileDescriptor opened(int parent, const char* name) {
  if (::fchmodat(parent, name, S_IRWXU, 0) != 0 && errno == ENOENT) return {};
  return FileDescriptor(::openat(parent, name, as_folder));
}

/// Empties the folder of all but folders that hold something. The name of the first of those; empty when
/// there is none. `failed` is set when something else is left.
std::string empty_but_folders(const FileDescriptor& folder, bool& failed) {
  const int copy = ::openat(folder.get(), ".", as_folder);
  const std::unique_ptr<DIR, CloseFolder> entries(copy < 0 ? nullptr : ::fdopendir(copy));
  if (!entries) {
    failed = true;
    return {};
  }
  std::string full;
  while (const dirent* entry = ::readdir(entries.get())) {
    const char* name = entry->d_name;
    if (std::strcmp(name, ".") == 0 || std::strcmp(name, "..") == 0) continue;
    if (::unlinkat(folder.get(), name, 0) == 0) continue;
    if (errno != EISDIR && errno != EPERM) {
      failed = true;
      continue;
    }
    if (::unlinkat(folder.get(), name, AT_REMOVEDIR) == 0) continue;
    if (errno != ENOTEMPTY && errno != EEXIST)
      failed = true;
    else if (full.empty())
      full = name;
  }
  return full;
}

/// Goes down into full folders and up again when they are empty; only the names of the way are kept.
bool empty_folder(FileDescriptor folder) {
  std::vector<std::string> way;
  for (;;) {
    bool failed = false;
    std::string full = empty_but_folders(folder, failed);
    if (failed) return false;
    if (!full.empty()) {
      folder = opened(folder.get(), full.c_str());
      if (!folder) return false;
      way.push_back(std::move(full));
      continue;
    }
    if (way.empty()) return true;
    folder = FileDescriptor(::openat(folder.get(), "..", as_folder));
    if (!folder || ::unlinkat(folder.get(), way.back().c_str(), AT_REMOVEDIR) != 0) return false;
    way.pop_back();
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
