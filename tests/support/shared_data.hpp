#pragma once
#include <cstdlib>
#include <filesystem>
#include "support/places.hpp"

namespace ream::test {

/// Where sample files (CT, meshes) that do not belong to the sources may be found: REAM_SHARED_DATA, else
/// shared/data beside the source folder. Tests that need one skip when it is absent.
inline std::filesystem::path shared_data(const std::filesystem::path& relative) {
  const char* given = std::getenv("REAM_SHARED_DATA");
  const std::filesystem::path folder =
      given != nullptr ? std::filesystem::path(given)
                       : std::filesystem::path(source_folder()).parent_path() / "shared" / "data";
  return folder / relative;
}

}  // namespace ream::test

/// Skips the test, with the reason printed, when the sample file is absent.
#define REAM_SKIP_WITHOUT(path) \
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "sample file " << (path) << " is absent"
