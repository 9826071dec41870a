#include "core/file_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

#include "core/error.hpp"

namespace ream {
namespace {

/// Who only looks holds a lock too, and so does a process that was just begun, with its copies of all
/// descriptors. Both let go at once, unless the system puts them aside.
constexpr std::chrono::milliseconds max_wait{100}, between_attempts{1};

int flock_uninterrupted(int descriptor, int operation) {
  int result = 0;
  do {
    result = ::flock(descriptor, operation);
  } while (result != 0 && errno == EINTR);
  return result;
}

}  // namespace

std::optional<FileLock> FileLock::attempt(const std::filesystem::path& path) {
  FileDescriptor file(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644));
  if (!file) throw Error(ErrorKind::io, "cannot make lock " + path.string() + ": " + std::strerror(errno));
  const auto last = std::chrono::steady_clock::now() + max_wait;
  while (flock_uninterrupted(file.get(), LOCK_EX | LOCK_NB) != 0) {
    if (errno != EWOULDBLOCK)
      throw Error(ErrorKind::io, "cannot lock " + path.string() + ": " + std::strerror(errno));
    if (std::chrono::steady_clock::now() >= last) return std::nullopt;
    std::this_thread::sleep_for(between_attempts);
  }
  // Whoever held it may have moved it away.
  struct stat locked {
  }, now{};
  if (::fstat(file.get(), &locked) != 0 || ::stat(path.c_str(), &now) != 0 || locked.st_ino != now.st_ino ||
      locked.st_dev != now.st_dev)
    return std::nullopt;
  return FileLock(std::move(file));
}

std::optional<FileLock> FileLock::attempt_existing(const std::filesystem::path& path) {
  FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
  if (!file || flock_uninterrupted(file.get(), LOCK_EX | LOCK_NB) != 0) return std::nullopt;
  return FileLock(std::move(file));
}

bool FileLock::held(const std::filesystem::path& path) {
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  return file && flock_uninterrupted(file.get(), LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
}

}  // namespace ream
