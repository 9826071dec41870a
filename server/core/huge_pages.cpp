#include "core/huge_pages.hpp"

#include <sys/mman.h>

#include <cstdint>

namespace ream {
namespace {

constexpr uintptr_t huge_page_bytes = 2u << 20;
/// Collapse at once, Linux 6.1; missing from the C library's headers of Debian 12.
constexpr int madv_collapse = 25;

}  // namespace

void prefer_huge_pages(const void* memory, size_t bytes) noexcept {
  const auto start = reinterpret_cast<uintptr_t>(memory);
  const uintptr_t first = (start + huge_page_bytes - 1) / huge_page_bytes * huge_page_bytes;
  const uintptr_t last = (start + bytes) / huge_page_bytes * huge_page_bytes;
  if (first >= last) return;
  void* const aligned = reinterpret_cast<void*>(first);
  ::madvise(aligned, last - first, MADV_HUGEPAGE);
  ::madvise(aligned, last - first, madv_collapse);
}

}  // namespace ream
