#include "record/log_sink.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/file_descriptor.hpp"

namespace ream::record {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path) {
  throw Error(ErrorKind::io, "cannot write " + path.string() + ": " + std::strerror(errno));
}

/// A file written at its end, locked against other writers until it is closed or its process has ended.
class LogFile final : public LogSink {
 public:
  LogFile(const std::filesystem::path& path, int flags)
      : path_(path), file_(::open(path.c_str(), O_WRONLY | O_CLOEXEC | flags, 0644)) {
    if (!file_) fail(path_);
    if (::flock(file_.get(), LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
    throw Error(ErrorKind::conflict, path_.string() + " is being written by another process");
  }

  void append(std::span<const std::byte> bytes) override {
    while (!bytes.empty()) {
      const ssize_t written = ::write(file_.get(), bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail(path_);
      bytes = bytes.subspan(static_cast<size_t>(written));
    }
  }

  void sync() override {
    while (::fsync(file_.get()) != 0)
      if (errno != EINTR) fail(path_);
  }

  void cut_to(uint64_t keep_bytes) {
    struct stat status {};
    if (::fstat(file_.get(), &status) != 0) fail(path_);
    const auto size = static_cast<uint64_t>(status.st_size);
    if (size < keep_bytes)
      throw Error(ErrorKind::io, "cannot go on writing " + path_.string() +
                                     ": it has become shorter than the " + std::to_string(keep_bytes) +
                                     " bytes that were read");
    if (size > keep_bytes) {
      if (::ftruncate(file_.get(), static_cast<off_t>(keep_bytes)) != 0) fail(path_);
      sync();
    }
    if (::lseek(file_.get(), static_cast<off_t>(keep_bytes), SEEK_SET) < 0) fail(path_);
  }

 private:
  const std::filesystem::path path_;
  const FileDescriptor file_;
};

}  // namespace

std::unique_ptr<LogSink> create_log_file(const std::filesystem::path& path) {
  auto file = std::make_unique<LogFile>(path, O_CREAT | O_EXCL);
  sync_folder(path.parent_path());
  return file;
}

std::unique_ptr<LogSink> continue_log_file(const std::filesystem::path& path, uint64_t keep_bytes) {
  auto file = std::make_unique<LogFile>(path, 0);
  file->cut_to(keep_bytes);
  return file;
}

}  // namespace ream::record
