#pragma once
#include <memory>

#include "core/error.hpp"
#include "core/progress.hpp"
#include "core/temporary_file.hpp"

namespace ream::reader {

/// A CT as people hand it over: a folder, a file, or a zip archive of one, which is unpacked into a folder in
/// `scratch` that goes away with this object.
class CtSource {
 public:
  /// What of a zip archive is unpacked at most: 20,000 files; 8 GB, and no more than 64 MB plus 200 times the
  /// archive's size, or than the disk has left.
  /// Errors, one line that names the archive: not_found; invalid_input for an archive that is damaged,
  /// encrypted, beyond those limits, with links or with names that lead out of it, with another archive in
  /// it, or without exactly one CT (DICOM files, or one volume file, or one text file of rows); io;
  /// cancelled.
  explicit CtSource(const std::filesystem::path& path, const Progress& progress = no_progress,
                    const std::filesystem::path& scratch = std::filesystem::temp_directory_path());

  /// What ct::read_ct takes.
  const std::filesystem::path& path() const { return path_; }

  /// action(path()); its errors name the archive instead of the folder it was unpacked to.
  template <typename Action>
  auto read(Action&& action) const {
    try {
      return action(path_);
    } catch (const Error& error) {
      throw Error(error.kind(), without_scratch(error.what()));
    }
  }

 private:
  std::string without_scratch(std::string message) const;

  std::filesystem::path given_, path_;
  std::unique_ptr<TemporaryFolder> unpacked_;
};

}  // namespace ream::reader
