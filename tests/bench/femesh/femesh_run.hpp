#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace ream::bench {

/// A folder for large files that goes away with its owner.
class BenchFolder {
 public:
  BenchFolder();
  ~BenchFolder();
  BenchFolder(const BenchFolder&) = delete;
  BenchFolder& operator=(const BenchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// `ream femesh` with these words and --json, a process of its own: what it printed. Error unavailable when
/// it fails.
nlohmann::json run_femesh(const std::string& words);

/// Writes so many bytes into a new file and waits for the disk: seconds.
double plain_write_s(const std::filesystem::path& file, uint64_t bytes);

}  // namespace ream::bench
