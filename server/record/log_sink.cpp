#include "record/log_sink.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/error.hpp"

namespace ream::record {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path) {
  throw Error(ErrorKind::io, "cannot write " + path.string() + ": " + std::strerror(errno));
}

void sync_folder_of(const std::filesystem::path& path) {
  const std::filesystem::path folder = path.parent_path();
  const int fd = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0) return;
  ::fsync(fd);
  ::close(fd);
}

/// A file written at its end, locked against other writers until it is closed or its process has ended.
class LogFile final : public LogSink {
 public:
  LogFile(const std::filesystem::path& path, int flags)
      : path_(path), fd_(::open(path.c_str(), O_WRONLY | O_CLOEXEC | flags, 0644)) {
    if (fd_ < 0) fail(path_);
    if (::flock(fd_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
    ::close(fd_);
    throw Error(ErrorKind::conflict, path_.string() + " is being written by another process");
  }
  ~LogFile() override { ::close(fd_); }
  LogFile(const LogFile&) = delete;
  LogFile& operator=(const LogFile&) = delete;

  void append(std::span<const std::byte> bytes) override {
    while (!bytes.empty()) {
      const ssize_t written = ::write(fd_, bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail(path_);
      bytes = bytes.subspan(static_cast<size_t>(written));
    }
  }

  void sync() override {
    while (::fsync(fd_) != 0)
      if (errno != EINTR) fail(path_);
  }

  void cut_to(uint64_t keep_bytes) {
    struct stat status {};
    if (::fstat(fd_, &status) != 0) fail(path_);
    const auto size = static_cast<uint64_t>(status.st_size);
    if (size < keep_bytes)
      throw Error(ErrorKind::io, "cannot go on writing " + path_.string() +
                                     ": it has become shorter than the " + std::to_string(keep_bytes) +
                                     " bytes that were read");
    if (size > keep_bytes) {
      if (::ftruncate(fd_, static_cast<off_t>(keep_bytes)) != 0) fail(path_);
      sync();
    }
    if (::lseek(fd_, static_cast<off_t>(keep_bytes), SEEK_SET) < 0) fail(path_);
  }

 private:
  const std::filesystem::path path_;
  const int fd_;
};

}  // namespace

std::unique_ptr<LogSink> create_log_file(const std::filesystem::path& path) {
  auto file = std::make_unique<LogFile>(path, O_CREAT | O_EXCL);
  sync_folder_of(path);
  return file;
}

std::unique_ptr<LogSink> continue_log_file(const std::filesystem::path& path, uint64_t keep_bytes) {
  auto file = std::make_unique<LogFile>(path, 0);
  file->cut_to(keep_bytes);
  return file;
}

}  // namespace ream::record
