#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "core/progress.hpp"

namespace ream::reader {

/// What a session bundle (session/export/session_bundle.hpp) says of its case.
struct SessionArchive {
  std::string case_id;
  uint64_t recorded_case = 0;             ///< hash of the case that the recording was made on
  std::optional<uint64_t> enclosed_case;  ///< hash of the one in the archive
};

/// Whether a file is a zip archive with a bundle.json.
bool holds_session(const std::filesystem::path& zip);

/// Unpacks a bundle into an empty folder and reads the recording and the case in it once, whole. Errors:
/// invalid_input; those of unpack_zip, Recording and load_case.
SessionArchive unpack_session(const std::filesystem::path& zip, const std::filesystem::path& folder,
                              const Progress& progress = no_progress);

}  // namespace ream::reader
