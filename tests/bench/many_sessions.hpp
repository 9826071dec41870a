#pragma once
#include <string>

#include "support/temporary_folder.hpp"

namespace ream::bench {

/// Writes session folders as two years of a training centre would leave them, s0 to s(count - 1), without
/// recordings. At least 672. `below`: a folder in `folder`, with its slash.
void write_sessions(const test::TemporaryFolder& folder, int count, const std::string& below = {});

}  // namespace ream::bench
