#include "session/simulation/case_cache.hpp"

namespace ream::session {
namespace fs = std::filesystem;

voxel::SharedBytes CaseCache::density_of(const std::string& key, fs::file_time_type written) {
  const std::lock_guard lock(mutex_);
  std::erase_if(known_, [](const auto& entry) { return entry.second.density.gone(); });
  const auto found = known_.find(key);
  if (found == known_.end() || found->second.written != written) return {};
  return found->second.density.get();
}

case_::Case CaseCache::load(const fs::path& folder) {
  std::error_code failed;
  const std::string key = fs::weakly_canonical(folder, failed).string();
  const auto written = fs::last_write_time(folder / "density.zst", failed);
  const voxel::SharedBytes known = density_of(key, written);
  case_::Case loaded = known.empty() ? case_::load_case(folder) : case_::load_case(folder, known);
  if (!failed && known.empty()) {
    const std::lock_guard lock(mutex_);
    known_[key] = {written, voxel::WatchedBytes(loaded.bone.density)};
  }
  return loaded;
}

}  // namespace ream::session
