#pragma once
#include <cstdlib>

namespace ream::test {

/// Whether tests that try a sample try all or far more, which takes hours: scripts/test --full says
/// so.
inline bool full_tests() { return std::getenv("REAM_FULL_TESTS") != nullptr; }

}  // namespace ream::test
