#pragma once
#include <cstddef>

namespace ream {

/// Keeps 1 MiB back for the moment at which there is no more memory. Whatever asks then gets it, once: C++
/// ends the program where a destructor or a noexcept function of a library finds none, and what handles an
/// error needs some. Who asks for more has std::bad_alloc. To be called at the start, and now and then, since
/// it is spent only once; true when it was spent since the last call. Safe in any thread.
bool keep_memory_reserve();

/// Locks what the process has mapped so far, and fills it, so that nobody who touches it waits: but for the
/// stacks of other threads of ours (start_thread), 8 MB each, of which what is touched stays. False when the
/// system refuses it.
bool lock_memory() noexcept;

/// Asks the kernel to back the memory with huge pages, now if it can: random look-ups in a large grid then
/// miss the address cache less often. Best effort: nothing depends on it, and refusal is silent.
void prefer_huge_pages(const void* memory, size_t bytes) noexcept;

}  // namespace ream
