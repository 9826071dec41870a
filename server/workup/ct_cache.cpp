#include "workup/ct_cache.hpp"

#include "ct/build/ct_workspace.hpp"

namespace ream::workup {
namespace fs = std::filesystem;
namespace {

constexpr size_t max_items = 6;

}  // namespace

template <typename T, typename Make>
std::shared_ptr<const T> CtCache::find_or_make(const std::string& case_id, const std::string& what,
                                               Make&& make) {
  const auto look = [&]() -> std::shared_ptr<const T> {
    for (auto item = items_.begin(); item != items_.end(); ++item)
      if (item->case_id == case_id && item->what == what) {
        Item found = std::move(*item);
        items_.erase(item);
        items_.push_front(found);
        return std::static_pointer_cast<const T>(found.contents);
      }
    return nullptr;
  };
  {
    const std::lock_guard lock(mutex_);
    if (auto found = look()) return found;
  }
  const auto made = std::make_shared<const T>(make());
  const std::lock_guard lock(mutex_);
  if (auto found = look()) return found;
  items_.push_front({case_id, what, made});
  if (items_.size() > max_items) items_.pop_back();
  return made;
}

CtCache::Hu CtCache::hu(const fs::path& case_folder, const ct::Workup& workup) {
  return find_or_make<std::vector<int16_t>>(workup.id, "hu",
                                            [&] { return ct::load_hu(case_folder, workup); });
}

CtCache::Labels CtCache::labels(const fs::path& case_folder, const ct::Workup& workup, int revision) {
  return find_or_make<std::vector<uint8_t>>(workup.id, "labels " + std::to_string(revision),
                                            [&] { return ct::load_labels(case_folder, workup, revision); });
}

CtCache::Bone CtCache::bone(const fs::path& case_folder, const ct::Workup& workup) {
  const int revision = workup.segmentation() ? workup.segmentation()->revision : 0;
  return find_or_make<voxel::BoneModel>(workup.id, "bone " + std::to_string(revision), [&] {
    return ct::scapula_of(workup, *hu(case_folder, workup), *labels(case_folder, workup, revision));
  });
}

void CtCache::forget(const std::string& case_id) {
  const std::lock_guard lock(mutex_);
  std::erase_if(items_, [&](const Item& item) { return item.case_id == case_id; });
}

}  // namespace ream::workup
