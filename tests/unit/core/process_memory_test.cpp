#include "core/process_memory.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <future>
#include <new>
#include <thread>
#include <vector>

#include "core/file_descriptor.hpp"
#include "core/signal_handlers.hpp"
#include "core/thread_stacks.hpp"

namespace ream {
namespace {

constexpr size_t small_bytes = 1000, too_many = 1'000'000;

/// No more addresses than the process has now. Takes no memory itself: a heap would grow by much more.
void limit_addresses() {
  std::array<char, 64> text{};
  const FileDescriptor statistics(::open("/proc/self/statm", O_RDONLY | O_CLOEXEC));
  if (::read(statistics.get(), text.data(), text.size() - 1) <= 0) std::_Exit(1);
  const uint64_t pages = std::strtoull(text.data(), nullptr, 10);
  rlimit bounds{};
  ::getrlimit(RLIMIT_AS, &bounds);
  bounds.rlim_cur = pages * static_cast<uint64_t>(::getpagesize());
  if (::setrlimit(RLIMIT_AS, &bounds) != 0) std::_Exit(1);
}
/// As many as it may have; takes none itself.
void lift_limit() {
  rlimit bounds{};
  ::getrlimit(RLIMIT_AS, &bounds);
  bounds.rlim_cur = bounds.rlim_max;
  if (::setrlimit(RLIMIT_AS, &bounds) != 0) std::_Exit(1);
}

/// How many small blocks there are until there is none.
size_t small_blocks() {
  size_t blocks = 0;
  while (blocks < too_many && ::operator new(small_bytes, std::nothrow) != nullptr) ++blocks;
  return blocks;
}

/// In a process of its own, for it changes what the process may have. Exit code 0: all was as it must be.
[[noreturn]] void run_out_of_memory() {
  limit_addresses();
  if (small_blocks() == too_many) std::_Exit(2);
  lift_limit();
  if (keep_memory_reserve()) std::_Exit(3);
  limit_addresses();
  const size_t blocks = small_blocks();
  if (blocks < 100 || blocks > 1100) std::_Exit(4);
  lift_limit();
  if (!keep_memory_reserve()) std::_Exit(5);  // it was spent
  if (keep_memory_reserve()) std::_Exit(6);
  std::_Exit(0);
}

TEST(MemoryReserve, IsGivenToWhoAsksFirstAndOnlyOnce) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the sanitizer's own allocator ends the program";
#endif
  EXPECT_EXIT(run_out_of_memory(), testing::ExitedWithCode(0), "");
  // Another thread has a heap of its own.
  EXPECT_EXIT(std::thread(run_out_of_memory).join(), testing::ExitedWithCode(0), "");
}

/// How much of a range is in memory, bytes.
size_t resident_bytes(uintptr_t begin, size_t bytes) {
  const auto page = static_cast<size_t>(::getpagesize());
  std::vector<unsigned char> pages(bytes / page);
  if (::mincore(reinterpret_cast<void*>(begin), bytes, pages.data()) != 0) return 0;
  return page * static_cast<size_t>(
                    std::count_if(pages.begin(), pages.end(), [](auto each) { return (each & 1) != 0; }));
}

TEST(LockedMemory, IsAllThereButTheStacksOfOtherThreads) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the sanitizer's shadow would be filled";
#endif
  std::promise<StackRange> own;
  std::promise<void> leave;
  std::thread other = start_thread([&] {
    char here = 0;
    const auto at = reinterpret_cast<uintptr_t>(&here);
    own.set_value({at, at});
    leave.get_future().wait();
  });
  const uintptr_t in_other = own.get_future().get().begin;
  constexpr size_t untouched_bytes = size_t{4} << 20;
  void* const untouched =
      ::mmap(nullptr, untouched_bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  const auto place = reinterpret_cast<uintptr_t>(untouched);
  const auto stacks = stacks_of_other_threads();
  const auto stack = std::find_if(stacks.begin(), stacks.end(), [&](const StackRange& each) {
    return in_other >= each.begin && in_other < each.end;
  });
  ASSERT_NE(stack, stacks.end());
  EXPECT_EQ(resident_bytes(place, untouched_bytes), 0u);
  const bool locked = lock_memory();
  const size_t filled = resident_bytes(place, untouched_bytes),
               of_stack = resident_bytes(stack->begin, stack->end - stack->begin);
  ::munlockall();
  leave.set_value();
  other.join();
  ::munmap(untouched, untouched_bytes);
  if (!locked) GTEST_SKIP() << "this user may not lock memory";
  EXPECT_EQ(filled, untouched_bytes);
  EXPECT_GT(of_stack, 0u);
  EXPECT_LT(of_stack, size_t{1} << 20) << "of " << stack->end - stack->begin;
  const auto left = stacks_of_other_threads();
  EXPECT_TRUE(
      std::none_of(left.begin(), left.end(), [&](const auto& each) { return each.begin == stack->begin; }));
}

}  // namespace
}  // namespace ream
