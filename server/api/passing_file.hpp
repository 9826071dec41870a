#pragma once
#include <filesystem>
#include <string>

#include "net/file_body.hpp"

namespace ream::api {

/// A file that is made to be sent once: it goes when this does, but what has been opened stays readable.
class PassingFile {
 public:
  /// A name of its own in `folder` (empty: the system's for temporary files), ending in `ending` (".csv").
  /// Makes the folder, not the file.
  PassingFile(const std::filesystem::path& folder, const std::string& ending);
  ~PassingFile();
  PassingFile(const PassingFile&) = delete;
  PassingFile& operator=(const PassingFile&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace ream::api
