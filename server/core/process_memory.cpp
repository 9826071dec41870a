#include "core/process_memory.hpp"

#include <sys/mman.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <fstream>
#include <new>
#include <sstream>
#include <string>
#include <vector>

#include "core/thread_stacks.hpp"

namespace ream {
namespace {

constexpr uintptr_t huge_page_bytes = 2u << 20;
/// Collapse at once, Linux 6.1; missing from the C library's headers of Debian 12.
constexpr int madv_collapse = 25;

constexpr size_t reserve_bytes = size_t{1} << 20;
std::atomic<void*> reserve{nullptr};
std::atomic<bool> spent{false};

/// Pages of the system's, so that it does not matter which thread's heap ran out.
void* taken_pages() {
  void* const pages =
      ::mmap(nullptr, reserve_bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  return pages == MAP_FAILED ? nullptr : pages;
}

void spend_reserve() {
  void* const kept = reserve.exchange(nullptr);
  if (kept == nullptr) throw std::bad_alloc();
  spent = true;
  ::munmap(kept, reserve_bytes);
}

/// Linux 5.14; missing from the C library's headers of Debian 12.
constexpr int madv_populate_read = 22, madv_populate_write = 23;

/// A line of /proc/self/maps.
struct Mapping {
  uintptr_t begin = 0, end = 0;
  std::string rights, rest;
};

std::vector<Mapping> mappings() {
  std::vector<Mapping> all;
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    Mapping mapping;
    char dash = 0;
    std::istringstream words(line);
    if (words >> std::hex >> mapping.begin >> dash >> mapping.end >> mapping.rights &&
        std::getline(words, mapping.rest))
      all.push_back(std::move(mapping));
  }
  return all;
}

void fill(uintptr_t begin, uintptr_t end, int how) {
  // NOLINTNEXTLINE(performance-no-int-to-ptr): the kernel tells addresses in words
  if (begin < end) ::madvise(reinterpret_cast<void*>(begin), end - begin, how);
}

/// What cannot be filled, such as a device's memory, is left.
void fill_but(const Mapping& mapping, const std::vector<StackRange>& stacks) {
  if (mapping.rights.front() != 'r' || mapping.rest.find("[v") != std::string::npos) return;
  // Others see what is written to shared memory.
  const bool is_own = mapping.rights.at(1) == 'w' && mapping.rights.at(3) == 'p';
  const int how = is_own ? madv_populate_write : madv_populate_read;
  uintptr_t from = mapping.begin;
  for (const StackRange& stack : stacks) {
    if (stack.end <= from || stack.begin >= mapping.end) continue;
    fill(from, stack.begin, how);
    from = stack.end;
  }
  fill(from, mapping.end, how);
}

bool can_fill() {
  alignas(4096) static std::array<char, 4096> page;
  return ::madvise(page.data(), page.size(), madv_populate_read) == 0;
}

bool fill_all_but_stacks() {
  if (!can_fill()) return false;
  const std::vector<StackRange> stacks = stacks_of_other_threads();
  for (const Mapping& mapping : mappings()) fill_but(mapping, stacks);
  return true;
}

}  // namespace

bool lock_memory() noexcept {
  if (::mlockall(MCL_CURRENT | MCL_ONFAULT) != 0) return false;
  try {
    if (fill_all_but_stacks()) return true;
  } catch (...) {  // then the system does it, with all stacks
  }
  return ::mlockall(MCL_CURRENT) == 0;
}

bool keep_memory_reserve() {
  std::set_new_handler(spend_reserve);
  if (reserve == nullptr) {
    void *fresh = taken_pages(), *none = nullptr;
    if (fresh != nullptr && !reserve.compare_exchange_strong(none, fresh)) ::munmap(fresh, reserve_bytes);
  }
  return spent.exchange(false);
}

void prefer_huge_pages(const void* memory, size_t bytes) noexcept {
  const auto start = reinterpret_cast<uintptr_t>(memory);
  const uintptr_t first = (start + huge_page_bytes - 1) / huge_page_bytes * huge_page_bytes;
  const uintptr_t last = (start + bytes) / huge_page_bytes * huge_page_bytes;
  if (first >= last) return;
  void* const aligned = reinterpret_cast<void*>(first);  // NOLINT(performance-no-int-to-ptr)
  ::madvise(aligned, last - first, MADV_HUGEPAGE);
  ::madvise(aligned, last - first, madv_collapse);
}

}  // namespace ream
