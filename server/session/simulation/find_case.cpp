#include "session/simulation/find_case.hpp"

#include "case/two_plates.hpp"
#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "ct/build/surroundings.hpp"
#include "ct/phantom/phantom_case.hpp"
#include "session/simulation/recorded_setup.hpp"

namespace ream::session {
namespace fs = std::filesystem;
namespace {

void require_computable(const record::Recording& recording) {
  if (recording.header().settings.empty())
    throw Error(ErrorKind::invalid_input,
                recording.log().path().string() +
                    " is of an older revision that does not say enough to go through it or compute it again");
}

/// Those that come with the program are made where they are first asked for.
void make_built_in(const std::string& name, const fs::path& data) {
  if (name == "demo") ct::load_or_make_demo_case(data);
  if (case_::is_two_plates(name)) case_::keep_two_plates(data_folder(data), name);
}

}  // namespace

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

fs::path case_folder_of(const std::string& name, const fs::path& data) {
  return case_::is_two_plates(name) ? case_::two_plates_folder(data_folder(data), name)
                                    : case_path(name, data);
}

case_::Case find_case(const std::string& name, const fs::path& data) {
  static CaseCache cache;
  const fs::path folder = case_folder_of(name, data);
  if (!fs::exists(folder / "case.json")) make_built_in(name, data);
  return cache.load(folder);
}

TriangleMesh case_surroundings(const std::string& name, const fs::path& data) {
  return ct::kept_surroundings(case_folder_of(name, data));
}

case_::Anatomy find_anatomy(const case_::Case& c, const std::string& name, const fs::path& data) {
  return case_::anatomy_of(c, case_folder_of(name, data));
}

case_::Case recorded_case(const record::Recording& recording, const std::string& case_name,
                          const std::filesystem::path& data) {
  require_computable(recording);
  const std::string& recorded_id = recording.header().case_id;
  case_::Case found;
  try {
    found = find_case(case_name.empty() ? recorded_id : case_name, data);
  } catch (const Error& e) {
    throw Error(e.kind(), "the case '" + recorded_id + "' of this recording cannot be had (" + e.what() +
                              "); say where it is with --case");
  }
  return case_as_recorded(recording, std::move(found));
}

case_::Anatomy recorded_anatomy(const record::Recording& recording, const case_::Case& native,
                                const std::string& case_name, const std::filesystem::path& data) {
  const record::ops::Header& header = recording.header();
  if (header.anatomy.empty())
    return find_anatomy(native, case_name.empty() ? header.case_id : case_name, data);
  return anatomy_in(recording);
}

}  // namespace ream::session
