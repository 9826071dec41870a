#include "app/version.hpp"

namespace ream::app {

std::string version_text() { return "ream " REAM_VERSION; }

}  // namespace ream::app
