#pragma once
#include <cstddef>

namespace ream {

/// Asks the kernel to back the memory with huge pages, now if it can: random look-ups in a large grid then
/// miss the address cache less often. Best effort: nothing depends on it, and refusal is silent.
void prefer_huge_pages(const void* memory, size_t bytes) noexcept;

}  // namespace ream
