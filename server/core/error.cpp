#include "core/error.hpp"

namespace ream {

int exit_code(ErrorKind kind) { return kind == ErrorKind::usage ? 2 : 1; }

}  // namespace ream
