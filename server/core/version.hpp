#pragma once
#include <string>

namespace ream {

/// "ream 0.1.0".
std::string version_text();

}  // namespace ream
