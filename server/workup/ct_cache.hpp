#pragma once
#include <deque>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>

#include "ct/build/ct_workspace.hpp"
#include "voxel/bone_model.hpp"

namespace ream::workup {

/// What people look at of a case's CT: the newest few stay in memory. Thread-safe.
class CtCache {
 public:
  using Hu = std::shared_ptr<const std::vector<int16_t>>;
  using Labels = std::shared_ptr<const std::vector<uint8_t>>;
  using Bone = std::shared_ptr<const voxel::BoneModel>;

  /// `key` tells different contents apart. Errors: those of reading.
  Hu hu(const std::filesystem::path& case_folder, const ct::Workup& workup);
  Labels labels(const std::filesystem::path& case_folder, const ct::Workup& workup, int revision);
  /// The segmented scapula at the CT's own resolution, as large as its bounding box.
  Bone bone(const std::filesystem::path& case_folder, const ct::Workup& workup);
  /// Forgets everything of a case.
  void forget(const std::string& case_id);

 private:
  struct Item {
    std::string case_id, what;
    std::shared_ptr<const void> contents;
  };
  template <typename T, typename Make>
  std::shared_ptr<const T> find_or_make(const std::string& case_id, const std::string& what, Make&& make);

  std::mutex mutex_;
  std::deque<Item> items_;  ///< last used first
};

}  // namespace ream::workup
