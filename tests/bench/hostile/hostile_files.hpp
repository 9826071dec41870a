#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace ream::bench {

/// Files as somebody who wishes a server ill would make them, written below one folder. Beside the files lies
/// one that no reader may open; its values are known again wherever they come back.
class HostileFiles {
 public:
  explicit HostileFiles(std::filesystem::path folder);

  /// The next of an endless row of small CTs (DICOM, NRRD, NIfTI, MetaImage, text rows, zip archives of them)
  /// with random damage; the same for every run. A file or folder, which goes away with the next call.
  std::filesystem::path next_damaged();

  /// Files of at most 1 MB that claim or unpack to gigabytes.
  std::vector<std::filesystem::path> bombs() const;
  /// Volumes whose headers name the forbidden file, in many spellings.
  std::vector<std::filesystem::path> thieves() const;

  /// Whether values of the forbidden file are among these.
  static bool holds_forbidden(std::span<const int16_t> values);
  /// Whether the forbidden file and its folder are as they were.
  bool forbidden_is_untouched() const;

 private:
  struct Seed {
    std::string name;  ///< of the file; its folder is read where that is how such a CT comes
    std::string bytes;
    bool folder = false;
  };

  void add_seed(const std::filesystem::path& file, bool folder = false);
  std::string damaged(const std::string& bytes);
  std::filesystem::path forbidden() const { return folder_ / "private/secret.raw"; }

  std::filesystem::path folder_;
  std::vector<Seed> seeds_;
  std::mt19937 random_{1};
  uint64_t count_ = 0;
};

}  // namespace ream::bench
