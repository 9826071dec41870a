#include "core/temporary_file.hpp"

#include <stdlib.h>

#include <cerrno>
#include <cstring>
#include <random>

#include "core/error.hpp"
#include "core/hash.hpp"

namespace ream {
namespace fs = std::filesystem;
namespace {

std::string random_name() {
  std::random_device source;
  return to_hex(uint64_t{source()} << 32 | source());
}

}  // namespace

TemporaryFile::TemporaryFile(const fs::path& folder, const std::string& ending) {
  const fs::path place = folder.empty() ? fs::temp_directory_path() : folder;
  fs::create_directories(place);
  path_ = place / ("ream-" + random_name() + ending);
}

TemporaryFile::~TemporaryFile() {
  std::error_code ignored;
  fs::remove(path_, ignored);
}

TemporaryFolder::TemporaryFolder(const fs::path& beside) {
  std::string name = beside.string() + ".XXXXXX";
  if (::mkdtemp(name.data()) == nullptr)
    throw Error(ErrorKind::io, "cannot write " + beside.string() + ": " + std::strerror(errno));
  path_ = name;
  lock_ = FileLock::attempt_existing(path_);
}

TemporaryFolder::~TemporaryFolder() { remove_tree(path_); }

}  // namespace ream
