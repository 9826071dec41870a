#pragma once
#include <cstdlib>

namespace ream::test {

/// Whether tests that try a sample try all or far more, which takes hours: scripts/test --full says
/// so.
inline bool full_tests() { return std::getenv("REAM_FULL_TESTS") != nullptr; }

/// How many of `all` a test tries: all of them in full tests, else `sample`.
template <class Count>
Count tried_of(Count all, Count sample) {
  return full_tests() ? all : sample;
}

}  // namespace ream::test
