#include "core/streamed_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/replaceable.hpp"

namespace ream {
namespace {

constexpr size_t piece_bytes = size_t{1} << 20;

[[noreturn]] void fail(const std::filesystem::path& path) {
  throw Error(ErrorKind::io, "cannot write " + path.string() + ": " + std::strerror(errno));
}

std::filesystem::path temporary_beside(const std::filesystem::path& path) {
  std::filesystem::path name = path;
  name += "." + std::to_string(::getpid()) + ".tmp";
  return name;
}

}  // namespace

StreamedFile::StreamedFile(std::filesystem::path path)
    : path_(std::move(path)), temporary_(temporary_beside(path_)) {
  require_replaceable(path_);
  file_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file_ < 0) fail(path_);
  waiting_.reserve(2 * piece_bytes);
}

StreamedFile::~StreamedFile() {
  if (file_ >= 0) ::close(file_);
  if (!committed_) ::unlink(temporary_.c_str());
}

void StreamedFile::write(std::span<const std::byte> bytes) {
  waiting_.insert(waiting_.end(), bytes.begin(), bytes.end());
  if (waiting_.size() >= piece_bytes) flush();
}

void StreamedFile::flush() {
  for (size_t done = 0; done < waiting_.size();) {
    const ssize_t n = ::write(file_, waiting_.data() + done, waiting_.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(path_);
    done += static_cast<size_t>(n);
  }
  waiting_.clear();
}

void StreamedFile::finish() {
  if (file_ < 0) return;
  flush();
  if (::fsync(file_) != 0) fail(path_);
  const int file = file_;
  file_ = -1;
  if (::close(file) != 0) fail(path_);
}

void StreamedFile::commit() {
  finish();
  if (::rename(temporary_.c_str(), path_.c_str()) != 0) fail(path_);
  committed_ = true;
  sync_folder(path_.parent_path());
}

}  // namespace ream
