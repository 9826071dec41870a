#include "core/version.hpp"

namespace ream {

std::string version_text() { return "ream " REAM_VERSION; }

}  // namespace ream
