#include "ct/build/ct_workspace.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <span>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "ct/segment/threshold_suggestion.hpp"

namespace ream::ct {
namespace fs = std::filesystem;
namespace {

fs::path description_of(const fs::path& case_folder) { return case_folder / "ct" / "ct.json"; }
fs::path hu_of(const fs::path& case_folder) { return case_folder / "ct" / "hu.zst"; }
fs::path labels_of(const fs::path& case_folder, int revision) {
  return case_folder / "ct" / ("labels-" + std::to_string(revision) + ".zst");
}

void link_or_copy(const fs::path& from, const fs::path& to) {
  std::error_code failed;
  fs::create_hard_link(from, to, failed);
  if (failed) fs::copy_file(from, to, failed);
  if (failed) throw Error(ErrorKind::io, "cannot copy " + from.string() + ": " + failed.message());
}

/// Files of segmentations that ct.json no longer names.
void remove_forgotten(const fs::path& case_folder, const Workup& workup) {
  std::error_code failed;
  for (const auto& entry : fs::directory_iterator(case_folder / "ct", failed)) {
    const std::string name = entry.path().filename().string();
    const bool named = std::any_of(workup.segmentations.begin(), workup.segmentations.end(),
                                   [&](const SegmentationRecord& record) {
                                     return entry.path() == labels_of(case_folder, record.revision);
                                   });
    if (name.starts_with("labels-") && !named) fs::remove(entry.path(), failed);
  }
}

}  // namespace

bool has_workup(const fs::path& case_folder) {
  std::error_code failed;
  return fs::is_regular_file(description_of(case_folder), failed);
}

Workup load_workup(const fs::path& case_folder) {
  const fs::path file = description_of(case_folder);
  if (!has_workup(case_folder))
    throw Error(ErrorKind::not_found, case_folder.string() + " holds no CT: it has no ct/ct.json");
  return workup_from_json(read_json_file(file), file.string());
}

std::vector<int16_t> load_hu(const fs::path& case_folder, const Workup& workup) {
  std::vector<int16_t> hu(workup.volume.voxel_count());
  read_zstd_file(hu_of(case_folder), std::as_writable_bytes(std::span(hu)), "ct.json");
  return hu;
}

std::vector<uint8_t> load_labels(const fs::path& case_folder, const Workup& workup, int revision) {
  std::vector<uint8_t> labels(workup.volume.voxel_count());
  read_zstd_file(labels_of(case_folder, revision), std::as_writable_bytes(std::span(labels)), "ct.json");
  return labels;
}

Workup new_workup(const std::string& id, const std::string& name, case_::Side side, const HuVolume& volume) {
  Workup workup;
  workup.id = id;
  workup.name = name;
  workup.side = side;
  workup.volume.dims = volume.dims;
  workup.volume.spacing_mm = volume.spacing_mm;
  workup.volume.world_from_volume = volume.world_from_volume;
  workup.volume.source = volume.source;
  workup.volume.warnings = volume.warnings;
  const auto [low, high] = std::minmax_element(volume.hu.begin(), volume.hu.end());
  workup.hu_min = *low;
  workup.hu_max = *high;
  workup.suggested_threshold_hu = suggested_threshold_hu(volume);
  return workup;
}

void record_segmentation(Workup& workup, const SegmentationSettings& settings, const Segmentation& made) {
  workup.segmentations.push_back({++workup.last_revision, settings, made.threshold_hu, made.parts, made.head,
                                  made.glenoid_mm, made.warnings});
  if (workup.segmentations.size() > kept_segmentations)
    workup.segmentations.erase(workup.segmentations.begin());
}

void write_workup(const fs::path& folder, const Workup& workup, const std::vector<int16_t>& hu,
                  const std::vector<uint8_t>& labels) {
  fs::create_directories(folder / "ct");
  write_zstd_file(hu_of(folder), std::as_bytes(std::span(hu)));
  if (workup.segmentation())
    write_zstd_file(labels_of(folder, workup.last_revision), std::as_bytes(std::span(labels)));
  save_workup(folder, workup);
}

Workup create_workup(const fs::path& case_folder, const std::string& id, const std::string& name,
                     case_::Side side, const HuVolume& volume) {
  const Workup workup = new_workup(id, name, side, volume);
  AtomicFolder folder(case_folder);
  write_workup(folder.path(), workup, volume.hu, {});
  folder.commit();
  return workup;
}

Workup copy_workup(const fs::path& from, const fs::path& to, const std::string& id, const std::string& name,
                   case_::Side side) {
  Workup workup = load_workup(from);
  workup.id = id;
  workup.name = name;
  workup.side = side;
  workup.segmentations.clear();
  workup.last_revision = 0;
  workup.built.reset();
  AtomicFolder folder(to);
  fs::create_directories(folder.path() / "ct");
  link_or_copy(hu_of(from), hu_of(folder.path()));
  save_workup(folder.path(), workup);
  folder.commit();
  return workup;
}

void add_segmentation(const fs::path& case_folder, Workup& workup, const SegmentationSettings& settings,
                      const Segmentation& made) {
  Workup changed = workup;
  record_segmentation(changed, settings, made);
  write_zstd_file(labels_of(case_folder, changed.last_revision), std::as_bytes(std::span(made.labels)));
  save_workup(case_folder, changed);
  remove_forgotten(case_folder, changed);
  workup = std::move(changed);
}

void undo_segmentation(const fs::path& case_folder, Workup& workup) {
  if (workup.segmentations.size() < 2)
    throw Error(ErrorKind::conflict, "case '" + workup.id + "' has no segmentation to go back to");
  Workup changed = workup;
  changed.segmentations.pop_back();
  save_workup(case_folder, changed);
  remove_forgotten(case_folder, changed);
  workup = std::move(changed);
}

void save_workup(const fs::path& case_folder, const Workup& workup) {
  write_json_file(description_of(case_folder), to_json(workup));
}

}  // namespace ream::ct
