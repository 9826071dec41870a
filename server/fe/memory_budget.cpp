#include "fe/memory_budget.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace ream::fe {
namespace {

constexpr uint64_t megabyte = 1'000'000;
/// Of the program itself and of the buffers of two threads that format text.
constexpr uint64_t always_bytes = 120 * megabyte;
/// What is lent even when nothing is left: small meshes are made whatever the limit.
constexpr uint64_t least_bytes = 4 * megabyte;

}  // namespace

MemoryBudget::MemoryBudget(uint64_t limit_bytes, std::filesystem::path folder)
    : limit_(limit_bytes), used_(always_bytes), folder_(std::move(folder)) {}

uint64_t MemoryBudget::left() const {
  if (limit_ == UINT64_MAX) return UINT64_MAX;
  return std::max(least_bytes, limit_ > used_ ? limit_ - used_ : 0);
}

void MemoryBudget::take(uint64_t bytes, const std::string& what) {
  if (!fits(bytes))
    throw Error(ErrorKind::invalid_input,
                what + " needs " + std::to_string(bytes / megabyte + 1) + " MB; give --memory-mb " +
                    std::to_string((used_ + bytes) / megabyte + 1) + " or more, or a smaller region");
  used_ += limit_ == UINT64_MAX ? 0 : bytes;
}

void MemoryBudget::give_back(uint64_t bytes) { used_ -= std::min(used_, limit_ == UINT64_MAX ? 0 : bytes); }

}  // namespace ream::fe
