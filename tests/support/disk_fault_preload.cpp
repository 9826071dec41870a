/// A disk that fails once, for LD_PRELOAD: one call of open, write, fsync or rename below a folder does
/// nothing and says so (disk_fault.hpp).
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>

#include <dlfcn.h>

#include "support/disk_fault.hpp"

namespace {

std::atomic<long> seen{0};

std::string_view variable(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? std::string_view() : value;
}

std::string name_of(int file) {
  std::array<char, 4096> name{};
  const std::string link = "/proc/self/fd/" + std::to_string(file);
  const long size = ::syscall(SYS_readlinkat, AT_FDCWD, link.c_str(), name.data(), name.size());
  return size > 0 ? std::string(name.data(), static_cast<size_t>(size)) : std::string();
}

std::string absolute(int folder, const char* path) {
  if (path == nullptr || path[0] == '/') return path == nullptr ? "" : path;
  if (folder != AT_FDCWD) return name_of(folder) + '/' + path;
  std::array<char, 4096> here{};
  return ::syscall(SYS_getcwd, here.data(), here.size()) > 0 ? std::string(here.data()) + '/' + path : path;
}

/// Whether this call is the one that fails.
bool fails(std::string_view kind, const std::string& path) {
  const std::string_view below = variable(ream::test::disk_fault_folder_variable);
  if (below.empty() || !path.starts_with(below) || variable(ream::test::disk_fault_call_variable) != kind)
    return false;
  return ++seen == std::atol(std::string(variable(ream::test::disk_fault_number_variable)).c_str());
}

long failed(int why) {
  errno = why;
  return -1;
}

int open_one(int folder, const char* path, int flags, mode_t mode) {
  if (fails("open", absolute(folder, path))) return static_cast<int>(failed(EIO));
  return static_cast<int>(::syscall(SYS_openat, folder, path, flags, mode));
}

mode_t mode_of(int flags, va_list& more) {
  return (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(more, mode_t) : 0;
}

int rename_one(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) {
  if (fails("rename", absolute(to_folder, to))) return static_cast<int>(failed(EIO));
  return static_cast<int>(::syscall(SYS_renameat2, from_folder, from, to_folder, to, flags));
}

int sync_one(int file, long call) {
  if (fails("fsync", name_of(file))) return static_cast<int>(failed(EIO));
  return static_cast<int>(::syscall(call, file));
}

struct Count {
  ~Count() {
    const std::string file(variable(ream::test::disk_fault_count_variable));
    if (file.empty()) return;
    const long to = ::syscall(SYS_openat, AT_FDCWD, file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    const std::string text = std::to_string(seen.load());
    if (to < 0 || ::syscall(SYS_write, to, text.data(), text.size()) < 0) std::abort();
  }
} count_at_the_end;

}  // namespace

extern "C" {
int open(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = mode_of(flags, more);
  va_end(more);
  return open_one(AT_FDCWD, path, flags, mode);
}
int open64(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = mode_of(flags, more);
  va_end(more);
  return open_one(AT_FDCWD, path, flags, mode);
}
int openat(int folder, const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = mode_of(flags, more);
  va_end(more);
  return open_one(folder, path, flags, mode);
}
FILE* fopen(const char* path, const char* mode) {
  static const auto next = reinterpret_cast<FILE* (*)(const char*, const char*)>(::dlsym(RTLD_NEXT, "fopen"));
  if (!fails("open", absolute(AT_FDCWD, path))) return next(path, mode);
  failed(EIO);
  return nullptr;
}
int mkdir(const char* path, mode_t mode) {
  if (fails("open", absolute(AT_FDCWD, path))) return static_cast<int>(failed(ENOSPC));
  return static_cast<int>(::syscall(SYS_mkdirat, AT_FDCWD, path, mode));
}
ssize_t write(int file, const void* bytes, size_t size) {
  return fails("write", name_of(file)) ? failed(ENOSPC) : ::syscall(SYS_write, file, bytes, size);
}
ssize_t pwrite(int file, const void* bytes, size_t size, off_t at) {
  return fails("write", name_of(file)) ? failed(ENOSPC) : ::syscall(SYS_pwrite64, file, bytes, size, at);
}
ssize_t pwrite64(int file, const void* bytes, size_t size, off64_t at) {
  return pwrite(file, bytes, size, at);
}
ssize_t writev(int file, const iovec* parts, int count) {
  return fails("write", name_of(file)) ? failed(ENOSPC) : ::syscall(SYS_writev, file, parts, count);
}
size_t fwrite(const void* bytes, size_t size, size_t count, FILE* file) {
  using Fwrite = size_t (*)(const void*, size_t, size_t, FILE*);
  static const auto next = reinterpret_cast<Fwrite>(::dlsym(RTLD_NEXT, "fwrite"));
  if (!fails("write", name_of(::fileno(file)))) return next(bytes, size, count, file);
  constexpr int error_seen = 0x20;  // what ferror() looks at
  file->_flags |= error_seen;
  failed(ENOSPC);
  return 0;
}
int fsync(int file) { return sync_one(file, SYS_fsync); }
int fdatasync(int file) { return sync_one(file, SYS_fdatasync); }
int rename(const char* from, const char* to) { return rename_one(AT_FDCWD, from, AT_FDCWD, to, 0); }
int renameat(int from_folder, const char* from, int to_folder, const char* to) {
  return rename_one(from_folder, from, to_folder, to, 0);
}
int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) {
  return rename_one(from_folder, from, to_folder, to, flags);
}
}
