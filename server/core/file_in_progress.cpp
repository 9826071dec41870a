#include "core/file_in_progress.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/replaceable.hpp"

namespace ream {

FileInProgress::FileInProgress(std::filesystem::path final_path)
    : final_(std::move(final_path)), temporary_(final_) {
  require_replaceable(final_);
  temporary_ += "." + std::to_string(::getpid()) + ".tmp";
  fd_ = ::open(temporary_.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (fd_ < 0) fail();
}

FileInProgress::~FileInProgress() {
  if (fd_ >= 0) ::close(fd_);
  if (!committed_) ::unlink(temporary_.c_str());
}

void FileInProgress::fail() const {
  throw Error(ErrorKind::io, "cannot write " + final_.string() + ": " + std::strerror(errno));
}

void FileInProgress::write_at(uint64_t offset, std::span<const std::byte> bytes) const {
  const auto begin = static_cast<off_t>(offset);
  const std::byte* data = bytes.data();
  for (size_t left = bytes.size(); left > 0;) {
    const ssize_t n = ::pwrite(fd_, data, left, static_cast<off_t>(offset));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail();
    data += n;
    offset += static_cast<uint64_t>(n);
    left -= static_cast<size_t>(n);
  }
  ::sync_file_range(fd_, begin, static_cast<off_t>(bytes.size()), SYNC_FILE_RANGE_WRITE);
}

void FileInProgress::finish() {
  if (finished_) return;
  if (::fsync(fd_) != 0) fail();
  finished_ = true;
}

void FileInProgress::commit() {
  finish();
  if (::rename(temporary_.c_str(), final_.c_str()) != 0) fail();
  committed_ = true;
  sync_folder(final_.parent_path());
}

}  // namespace ream
