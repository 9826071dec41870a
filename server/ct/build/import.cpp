#include "ct/build/import.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "ct/build/surroundings.hpp"
#include "ct/read/read_ct.hpp"
#include "ct/read/write_volume.hpp"
#include "ct/segment/label_map.hpp"

namespace ream::ct {
namespace {

HuVolume read_volume(const std::filesystem::path& path, const ImportOptions& options,
                     const Progress& progress) {
  ReadOptions reading;
  reading.series_uid = options.series_uid;
  reading.keep_names = options.keep_names;
  HuVolume volume = read_ct(path, reading, progress);
  if (!options.side) volume.warnings.push_back("no --side was given; the case is marked as a right shoulder");
  if (options.build.roi_mm) cropped(volume, *options.build.roi_mm);  // refuses a region outside at once
  return volume;
}

std::string name_of(const HuVolume& volume, const std::string& id, const ImportOptions& options) {
  if (!options.name.empty()) return options.name;
  return volume.patient ? volume.patient->name + " (" + volume.patient->id + ")" : id;
}

Segmentation segmentation_of(const HuVolume& volume, const ImportOptions& options,
                             const SegmentationSettings& settings, const Progress& progress) {
  if (!options.label) return segment_shoulder(volume, settings, progress);
  LabelValues values;
  values.scapula = options.label_value;
  return segmentation_from_labels(volume, read_volume_file(*options.label), values);
}

void require_glenoid(const GlenoidPlace& glenoid, const BuildSettings& build) {
  const bool needed = (build.around_glenoid && !build.roi_mm) || build.cartilage_mm > 0.0;
  if (needed && !glenoid.centre_mm)
    throw Error(ErrorKind::invalid_input,
                "where the glenoid is was not found; give its centre with --glenoid X,Y,Z (LPS mm)");
}

}  // namespace

Imported import_ct(const std::filesystem::path& path, const std::string& id, const ImportOptions& options,
                   const Progress& progress) {
  HuVolume volume = read_volume(path, options, part_of(progress, 0.0, 0.3));
  SegmentationSettings settings = options.segmentation;
  settings.side = options.side.value_or(case_::Side::right);
  Imported imported;
  Workup& workup = imported.workup = new_workup(id, name_of(volume, id, options), settings.side, volume);
  Segmentation made = segmentation_of(volume, options, settings, part_of(progress, 0.3, 0.7));
  record_segmentation(workup, settings, made);
  if (options.labels_out) write_label_map(volume, made.labels, *options.labels_out);
  const GlenoidPlace glenoid = glenoid_place(*workup.segmentation(), workup.side, options.glenoid_mm);
  require_glenoid(glenoid, options.build);
  imported.hu = std::move(volume.hu);
  imported.labels = std::move(made.labels);
  imported.made =
      build_from(workup, imported.hu, imported.labels, glenoid, options.build, part_of(progress, 0.7, 1.0));
  progress(1.0, "case ready");
  return imported;
}

void save_imported(const Imported& imported, const std::filesystem::path& folder, bool replace) {
  const case_::Case& made = imported.made;
  AtomicFolder target(folder, replace);
  write_workup(target.path(), imported.workup, imported.hu, imported.labels);
  case_::save_bone(made, target.path());
  keep_surroundings(scapula_around(imported.workup, imported.hu, imported.labels, made.bone.grid), made.side,
                    target.path());
  if (made.plan) case_::save_plan(*made.plan, target.path());
  if (imported.landmarks) case_::save_landmarks(*imported.landmarks, target.path());
  target.commit();
}

std::string case_id_from(const std::filesystem::path& folder) {
  std::filesystem::path named = std::filesystem::absolute(folder).lexically_normal();
  if (!named.has_filename()) named = named.parent_path();
  std::string id;
  for (const char c : named.filename().string()) {
    const bool upper = c >= 'A' && c <= 'Z', kept = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
    if (upper)
      id += static_cast<char>(c - 'A' + 'a');
    else if (kept)
      id += c;
    else if (!id.empty() && id.back() != '-')
      id += '-';
  }
  while (!id.empty() && id.back() == '-') id.pop_back();
  return id.empty() ? "case" : id;
}

}  // namespace ream::ct
