#pragma once
#include <stdlib.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>

#include "core/error.hpp"

namespace ream::app {

/// A new folder, beside others and named after `beside`, that goes with its contents when it is no longer
/// needed.
struct PassingFolder {
  explicit PassingFolder(const std::filesystem::path& beside) {
    std::string name = beside.string() + ".XXXXXX";
    if (::mkdtemp(name.data()) == nullptr)
      throw Error(ErrorKind::io, "cannot write " + beside.string() + ": " + std::strerror(errno));
    path = name;
  }
  ~PassingFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  PassingFolder(const PassingFolder&) = delete;
  PassingFolder& operator=(const PassingFolder&) = delete;
  std::filesystem::path path;
};

}  // namespace ream::app
