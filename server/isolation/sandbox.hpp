#pragma once
#include <cstdint>
#include <span>
#include <string>

namespace ream::isolation {

struct SandboxLimits {
  uint64_t memory_bytes = 0, file_bytes = 0;
  unsigned processor_s = 0;
  bool compiles = false;   ///< memory that it has written may be run
  bool background = true;  ///< runs only when nothing else wants the processor
};

/// What this machine's kernel can close.
struct SandboxSupport {
  int landlock = 0;  ///< version of its interface; 0: not there
  bool seccomp = false;
};
SandboxSupport sandbox_support();

/// In one line for people: what protects this machine from files that it reads.
std::string sandbox_in_words(const SandboxSupport& support);

/// From now on this process opens only what lies at or below `inputs` (to read) and `output` (to read and
/// write), all open descriptors; has no network, starts no program, signals nobody; stays within the limits;
/// is the first to go when memory runs out. What the kernel does not have is left out. Throws Error io when
/// the kernel has something and refuses it.
void enter_sandbox(std::span<const int> inputs, int output, const SandboxLimits& limits);

}  // namespace ream::isolation
