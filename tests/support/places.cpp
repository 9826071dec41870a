#include "support/places.hpp"

namespace ream::test {

std::string source_folder() { return REAM_SOURCE_DIR; }
std::string build_folder() { return REAM_BINARY_DIR; }

}  // namespace ream::test
