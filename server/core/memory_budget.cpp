#include "core/memory_budget.hpp"

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>

#include "core/error.hpp"

namespace ream {
namespace {

constexpr uint64_t megabyte = 1'000'000;
/// Of the program itself and of the buffers of two threads that format text.
constexpr uint64_t always_bytes = 120 * megabyte;
/// What is lent even when nothing is left: small meshes are made whatever the limit.
constexpr uint64_t min_bytes = 4 * megabyte;

}  // namespace

MemoryBudget::MemoryBudget(uint64_t limit_bytes, std::filesystem::path folder)
    : limit_(limit_bytes), used_(always_bytes), folder_(std::move(folder)) {}

MemoryBudget MemoryBudget::with_left(uint64_t left_bytes, std::filesystem::path folder) {
  return {left_bytes > UINT64_MAX - always_bytes ? UINT64_MAX : left_bytes + always_bytes, std::move(folder)};
}

uint64_t MemoryBudget::left() const {
  if (limit_ == UINT64_MAX) return UINT64_MAX;
  return std::max(min_bytes, limit_ > used_ ? limit_ - used_ : 0);
}

void MemoryBudget::take(uint64_t bytes, const std::string& what) {
  if (!fits(bytes))
    throw Error(ErrorKind::invalid_input,
                what + " needs " + std::to_string(bytes / megabyte + 1) + " MB; give --memory-mb " +
                    std::to_string((used_ + bytes) / megabyte + 1) + " or more, or a smaller region");
  used_ += limit_ == UINT64_MAX ? 0 : bytes;
}

void MemoryBudget::give_back(uint64_t bytes) { used_ -= std::min(used_, limit_ == UINT64_MAX ? 0 : bytes); }

SpillFile::SpillFile(const std::filesystem::path& folder) : folder_(folder.empty() ? "." : folder) {
  std::string name = (folder_ / ".ream-XXXXXX").string();
  file_ = FileDescriptor(::mkostemp(name.data(), O_CLOEXEC));
  if (!file_) fail();
  ::unlink(name.c_str());
}

void SpillFile::fail() const {
  throw Error(ErrorKind::io, "cannot keep what does not fit into memory in " + folder_.string() + ": " +
                                 std::strerror(errno));
}

void SpillFile::write_at(uint64_t offset, std::span<const std::byte> bytes) {
  if (!file_.write_at(offset, bytes)) fail();
}

void SpillFile::read_at(uint64_t offset, std::span<std::byte> bytes) const {
  const ssize_t got = file_.read_at(offset, bytes);
  if (got >= 0 && static_cast<size_t>(got) < bytes.size()) errno = EIO;
  if (got < 0 || static_cast<size_t>(got) < bytes.size()) fail();
}

}  // namespace ream
