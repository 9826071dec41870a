#include "core/atomic_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/file.hpp"

namespace ream {
namespace fs = std::filesystem;
namespace {

constexpr size_t piece_bytes = size_t{1} << 20;

fs::path temporary_beside(const fs::path& path) {
  fs::path name = path;
  name += "." + std::to_string(::getpid()) + ".tmp";
  return name;
}

/// The same folder as a name that a sibling can be put beside ("a/b/" -> "/here/a/b", "." -> "/here").
fs::path without_trailing_slash(const fs::path& path) {
  const fs::path normal = fs::absolute(path).lexically_normal();
  return normal.has_filename() ? normal : normal.parent_path();
}

/// Parents go unless others use them by now.
void discard(const fs::path& folder, const std::vector<fs::path>& made_parents) {
  std::error_code ignored;
  fs::remove_all(folder, ignored);
  for (const fs::path& parent : made_parents) fs::remove(parent, ignored);
}

}  // namespace

void require_replaceable(const fs::path& path) {
  std::error_code failed;
  const auto present = fs::status(path, failed);
  if (fs::exists(present) && !fs::is_regular_file(present))
    throw Error(ErrorKind::io, "cannot write " + path.string() + ": it is no file; give the name of one");
}

AtomicFile::AtomicFile(fs::path final_path)
    : final_(std::move(final_path)), temporary_(temporary_beside(final_)) {
  require_replaceable(final_);
  fd_ = ::open(temporary_.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (fd_ < 0) fail();
  ::flock(fd_, LOCK_EX | LOCK_NB);  // says that its owner lives (leftovers.hpp)
}

AtomicFile::~AtomicFile() {
  if (fd_ >= 0) ::close(fd_);
  if (!committed_) ::unlink(temporary_.c_str());
}

void AtomicFile::fail() const {
  throw Error(ErrorKind::io, "cannot write " + final_.string() + ": " + std::strerror(errno));
}

void AtomicFile::write_at(uint64_t offset, std::span<const std::byte> bytes) const {
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

void AtomicFile::write(std::span<const std::byte> bytes) {
  if (waiting_.capacity() == 0) waiting_.reserve(2 * piece_bytes);
  waiting_.insert(waiting_.end(), bytes.begin(), bytes.end());
  if (waiting_.size() >= piece_bytes) flush();
}

void AtomicFile::flush() {
  if (waiting_.empty()) return;
  write_at(flushed_bytes_, waiting_);
  flushed_bytes_ += waiting_.size();
  waiting_.clear();
}

void AtomicFile::finish() {
  if (finished_) return;
  flush();
  if (::fsync(fd_) != 0) fail();
  finished_ = true;
}

void AtomicFile::commit() {
  finish();
  if (::rename(temporary_.c_str(), final_.c_str()) != 0) fail();
  committed_ = true;
  sync_folder(final_.parent_path());
}

AtomicFolder::AtomicFolder(fs::path final_path, bool replace)
    : final_(without_trailing_slash(final_path)), temporary_(temporary_beside(final_)) {
  std::error_code failed;
  if (fs::exists(final_, failed)) {
    if (!fs::is_directory(final_, failed))
      throw Error(ErrorKind::conflict, final_.string() + " exists and is not a folder; choose another place");
    if (!replace && !fs::is_empty(final_, failed))
      throw Error(ErrorKind::conflict, final_.string() + " exists and is not empty; choose another place");
  }
  fs::remove_all(temporary_, failed);
  for (fs::path p = final_.parent_path(); !fs::exists(p, failed) && p.has_relative_path();
       p = p.parent_path())
    made_parents_.push_back(p);
  try {
    make_writable_folder(temporary_);
  } catch (...) {
    discard(temporary_, made_parents_);
    throw;
  }
  lock_ = FileLock::attempt_existing(temporary_);
}

AtomicFolder::~AtomicFolder() {
  if (!committed_) discard(temporary_, made_parents_);
}

void AtomicFolder::commit() {
  const auto check = [&](const std::error_code& failed) {
    if (failed)
      throw Error(ErrorKind::io, "cannot write folder " + final_.string() + ": " + failed.message());
  };
  std::error_code failed, ignored;
  sync_tree(temporary_);
  // The old folder takes the temporary name in the same moment, so that there is always one.
  const bool exchanged =
      ::renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, final_.c_str(), RENAME_EXCHANGE) == 0;
  fs::path old = final_;
  old += "." + std::to_string(::getpid()) + ".old.tmp";
  const bool had_old = !exchanged && fs::exists(final_, ignored);
  if (!exchanged) {
    if (had_old) {
      fs::remove_all(old, ignored);
      fs::rename(final_, old, failed);
      check(failed);
    }
    fs::rename(temporary_, final_, failed);
    if (failed && had_old) fs::rename(old, final_, ignored);
    check(failed);
  }
  committed_ = true;
  try {
    sync_folder(final_.parent_path());
  } catch (const Error&) {
    // What cannot be promised to last is taken back.
    const unsigned back = exchanged ? RENAME_EXCHANGE : RENAME_NOREPLACE;
    committed_ = ::renameat2(AT_FDCWD, final_.c_str(), AT_FDCWD, temporary_.c_str(), back) != 0;
    if (!committed_ && had_old) fs::rename(old, final_, ignored);
    throw;
  }
  fs::remove_all(exchanged ? temporary_ : old, ignored);
}

}  // namespace ream
