#pragma once
#include <cstdint>
#include <vector>

namespace ream {

/// Addresses of a thread's stack, without its guard page.
struct StackRange {
  uintptr_t begin = 0, end = 0;
};

/// From here to the end of the calling thread its stack is known. Does nothing where there is no memory for
/// it.
void note_stack_of_this_thread() noexcept;
/// Of those that are known and live, by address, but the calling thread's.
std::vector<StackRange> stacks_of_other_threads();

}  // namespace ream
