#pragma once
#include <cassert>
#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace ream::fuzz {

/// Debian's GDCM ends its program where a packed picture breaks its assertions. In the product that is the
/// reader process, and its end is a refused file (integration_isolation); a fuzzer has to go on, and jumps
/// back to here. What the library held then is lost, which the standard does not allow and this fuzzer lives
/// with.
inline std::jmp_buf after_library_assert;

/// How often; said at the end.
struct LibraryAsserts {
  size_t count = 0;
  ~LibraryAsserts() {
    if (count > 0) std::fprintf(stderr, "%zu inputs broke an assertion of GDCM\n", count);
  }
};
inline LibraryAsserts library_asserts;

}  // namespace ream::fuzz

/// In place of the C library's, also for its callers in shared libraries. Assertions of our own still end it.
extern "C" void __assert_fail(const char* assertion, const char* file, unsigned line,
                              const char* function) noexcept {
  if (std::string_view(file).find("gdcm") != std::string_view::npos) {
    ++ream::fuzz::library_asserts.count;
    std::longjmp(ream::fuzz::after_library_assert, 1);
  }
  std::fprintf(stderr, "%s:%u: %s: assertion '%s' failed\n", file, line, function, assertion);
  std::abort();
}
