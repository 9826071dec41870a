#include "core/replaceable.hpp"

#include "core/error.hpp"

namespace ream {

void require_replaceable(const std::filesystem::path& path) {
  std::error_code failed;
  const auto present = std::filesystem::status(path, failed);
  if (std::filesystem::exists(present) && !std::filesystem::is_regular_file(present))
    throw Error(ErrorKind::io, "cannot write " + path.string() + ": it is no file; give the name of one");
}

}  // namespace ream
