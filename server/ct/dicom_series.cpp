#include "ct/dicom_series.hpp"

#include <algorithm>
#include <set>

#include "core/error.hpp"

namespace ream::ct {
namespace fs = std::filesystem;
namespace {

constexpr size_t max_files = 100000;

/// Also leaves out what other systems add to folders and archives (__MACOSX, ._name, .DS_Store).
std::vector<fs::path> files_below(const fs::path& path) {
  if (!fs::is_directory(path)) return {path};
  std::vector<fs::path> files;
  auto entry = fs::recursive_directory_iterator(path, fs::directory_options::skip_permission_denied);
  for (; entry != fs::recursive_directory_iterator(); ++entry) {
    const std::string name = entry->path().filename().string();
    if (entry->is_directory() && (name.starts_with('.') || name == "__MACOSX"))
      entry.disable_recursion_pending();
    else if (entry->is_regular_file() && !name.starts_with('.') && name != "DICOMDIR")
      files.push_back(entry->path());
    if (files.size() > max_files)
      throw Error(ErrorKind::invalid_input, path.string() + " holds more than " + std::to_string(max_files) +
                                                " files; give the folder of one CT series");
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// Whether the file holds pictures; refuses what is damaged.
bool holds_an_image(const fs::path& path, const DicomFile& file, int& imageless) {
  const bool named_dicom = path.extension() == ".dcm" || path.extension() == ".DCM";
  if (file.state == DicomState::damaged || (file.state == DicomState::not_dicom && named_dicom))
    throw Error(ErrorKind::invalid_input,
                path.string() + " is cut short or not DICOM; copy it again from its source or take it away");
  if (file.state == DicomState::no_pixels) ++imageless;
  return file.state == DicomState::whole;
}

}  // namespace

DicomScan scan_dicom(const fs::path& path, const Progress& progress) {
  DicomScan scan;
  const auto files = files_below(path);
  std::map<std::string, int> unusable;
  std::set<std::string> modalities;
  int imageless = 0, localizers = 0, other = 0;
  for (size_t i = 0; i < files.size(); ++i) {
    progress(static_cast<double>(i) / static_cast<double>(files.size()), "looking for slices");
    const DicomFile file = parse_dicom(files[i]);
    if (!holds_an_image(files[i], file, imageless)) continue;
    for (DicomSlice& slice : describe_dicom(files[i], file)) {
      if (slice.modality != "CT") {
        modalities.insert(slice.modality);
        ++other;
      } else if (slice.localizer) {
        ++localizers;
      } else if (!slice.unusable.empty()) {
        ++unusable[slice.unusable];
        if (scan.first_refused.empty())
          scan.first_refused = slice.file.string() + " holds a picture " + slice.unusable;
      } else {
        scan.series[slice.series_uid].push_back(std::move(slice));
      }
    }
  }
  for (const auto& modality : modalities)
    scan.other_modalities += (scan.other_modalities.empty() ? "" : ", ") + modality;
  const auto say = [&](int count, const std::string& what) {
    if (count > 0) scan.warnings.push_back(std::to_string(count) + " " + what);
  };
  say(imageless, "DICOM files without an image were passed over");
  say(other, "images that are no CT (" + scan.other_modalities + ") were left out");
  say(localizers, "survey images (localizers) were left out");
  for (const auto& [reason, count] : unusable) say(count, "images " + reason + " were left out");
  return scan;
}

}  // namespace ream::ct
