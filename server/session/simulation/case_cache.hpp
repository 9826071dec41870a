#pragma once
#include <filesystem>
#include <map>
#include <mutex>
#include <string>

#include "case/case.hpp"

namespace ream::session {

/// Loads cases so that those of one folder share their densities in memory, as long as any of them lives: a
/// further session on a case costs its coverage only. Thread-safe.
class CaseCache {
 public:
  /// As case_::load_case.
  case_::Case load(const std::filesystem::path& folder);

 private:
  struct Known {
    std::filesystem::file_time_type written;  ///< of density.zst
    voxel::WatchedBytes density;
  };
  voxel::SharedBytes density_of(const std::string& key, std::filesystem::file_time_type written);

  std::mutex mutex_;
  std::map<std::string, Known> known_;
};

}  // namespace ream::session
