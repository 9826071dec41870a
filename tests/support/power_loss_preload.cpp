/// A disk that keeps only what was synced, for LD_PRELOAD: each fsync of a file or folder on the device of
/// REAM_POWER_LOSS_KEPT copies what a disk would hold from then on into that folder. power_loss.cpp makes of
/// it what is left when the power goes.
#include <dirent.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdlib>
#include <string>

#include "support/power_loss.hpp"

namespace {

const char* kept_folder() { return std::getenv(ream::test::power_loss_variable); }

/// Appears under its name as a whole.
void keep(const std::string& name, int from, const std::string& text) {
  static std::atomic<int> count{0};
  const std::string path = std::string(kept_folder()) + "/" + name,
                    part = path + "." + std::to_string(::getpid()) + "." + std::to_string(++count);
  const int to = ::open(part.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  if (to < 0) std::abort();
  bool went = ::write(to, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  if (from >= 0) {
    std::array<char, 65536> piece;
    off_t at = 0;
    for (ssize_t n = 0; (n = ::pread(from, piece.data(), piece.size(), at)) > 0; at += n)
      went = went && ::write(to, piece.data(), static_cast<size_t>(n)) == n;
  }
  ::close(to);
  if (!went || ::rename(part.c_str(), path.c_str()) != 0) std::abort();
}

/// A line for each entry: its kind and identity, and its name.
std::string entries_of(int folder) {
  std::string lines;
  DIR* const stream = ::fdopendir(::openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (stream == nullptr) std::abort();
  for (const dirent* entry = nullptr; (entry = ::readdir(stream)) != nullptr;) {
    const std::string name = entry->d_name;
    if (name != "." && name != "..")
      lines += ream::test::identity_on_disk(::dirfd(stream), name.c_str()) + ' ' + name + '\n';
  }
  ::closedir(stream);
  return lines;
}

/// What `file` holds is on the disk from here on.
int sync_one(int file) {
  struct stat status {};
  if (kept_folder() == nullptr || ::fstat(file, &status) != 0)
    return static_cast<int>(::syscall(SYS_fsync, file));
  // A descriptor that can only write is opened once more.
  const std::string again = "/proc/self/fd/" + std::to_string(file);
  const std::string identity = ream::test::identity_on_disk(AT_FDCWD, again.c_str(), true);
  if (S_ISDIR(status.st_mode)) {
    keep(identity, -1, entries_of(file));
  } else if (S_ISREG(status.st_mode)) {
    const int reading = ::open(again.c_str(), O_RDONLY | O_CLOEXEC);
    if (reading < 0) return 0;  // it has no name any more
    keep(identity, reading, {});
    ::close(reading);
  }
  return 0;
}

}  // namespace

extern "C" {
int fsync(int file) { return sync_one(file); }
int fdatasync(int file) { return sync_one(file); }
}
