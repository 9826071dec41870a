#include "reader/ct_files.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "core/error.hpp"
#include "core/text.hpp"
#include "ct/read/ct_file_names.hpp"
#include "reader/slice_stack.hpp"
#include "reader/standard_terms.hpp"

namespace ream::reader {
namespace fs = std::filesystem;
namespace {

constexpr size_t max_files = 100000;
constexpr double scanning_share = 0.2;  // looking at headers takes about a fifth of reading everything

/// The CT pictures found in a folder.
struct DicomScan {
  std::map<std::string, std::vector<DicomSlice>> series;  ///< by UID: what can be a slice of a volume
  std::vector<std::string> warnings;                      ///< what was passed over
  std::string first_refused;                              ///< file and reason, when a CT picture was
  std::string other_modalities;                           ///< such as "MR, PT"
};

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
  const bool named_dicom = ct::kind_by_name(path) == ct::CtFileKind::dicom;
  if (file.state == DicomState::damaged || (file.state == DicomState::not_dicom && named_dicom))
    throw Error(ErrorKind::invalid_input,
                path.string() + " is cut short or not DICOM; copy it again from its source or take it away");
  if (file.state == DicomState::no_pixels) ++imageless;
  return file.state == DicomState::whole;
}

/// Looks at every file below a folder, or at one file. Hidden files, files that are not DICOM and DICOM
/// without pictures are passed over. Errors: invalid_input (names the file) for a file that is cut short or
/// says impossible things; cancelled.
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
        modalities.insert(standard_term(slice.modality));
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
  const auto warn = [&](int count, const std::string& what) {
    if (count > 0) scan.warnings.push_back(std::to_string(count) + " " + what);
  };
  warn(imageless, "DICOM files without an image were passed over");
  warn(other, "images that are no CT (" + scan.other_modalities + ") were left out");
  warn(localizers, "survey images (localizers) were left out");
  for (const auto& [reason, count] : unusable) warn(count, "images " + reason + " were left out");
  return scan;
}

void check_exists(const fs::path& path) {
  std::error_code failed;
  if (!fs::exists(path, failed))
    throw Error(ErrorKind::not_found, "no such file or folder: " + path.string());
}

using Series = std::pair<const std::string, std::vector<DicomSlice>>;

Error nothing_usable(const fs::path& path, const DicomScan& scan) {
  if (!scan.first_refused.empty())
    return {ErrorKind::invalid_input, scan.first_refused + "; that is no CT slice"};
  const std::string instead =
      scan.other_modalities.empty() ? "" : "; what is there is " + scan.other_modalities;
  return {ErrorKind::invalid_input, path.string() + " holds no CT slices (DICOM, modality CT)" + instead +
                                        "; give the folder of a CT series"};
}

const Series& chosen(const DicomScan& scan, const std::string& uid, const fs::path& path) {
  if (scan.series.empty()) throw nothing_usable(path, scan);
  if (uid.empty())
    return *std::max_element(scan.series.begin(), scan.series.end(), [](const Series& a, const Series& b) {
      return a.second.size() < b.second.size();
    });
  const auto found = scan.series.find(uid);
  if (found == scan.series.end())
    throw Error(ErrorKind::not_found, path.string() + " holds no CT series " + uid + "; it holds " +
                                          std::to_string(scan.series.size()) + " others, the first is " +
                                          scan.series.begin()->first);
  return *found;
}

void warn_of_burnt_in(HuVolume& volume, const std::vector<DicomSlice>& slices) {
  const auto count =
      std::count_if(slices.begin(), slices.end(), [](const DicomSlice& slice) { return slice.burnt_in; });
  if (count > 0)
    volume.warnings.push_back(
        std::to_string(count) +
        " slices say that words are burnt into their pictures, perhaps whose they are; look "
        "through them, and delete the case if they tell");
}

void warn_of_value_type(HuVolume& volume, const DicomSlice& slice) {
  if (slice.value_type == "unscaled")
    volume.warnings.push_back("the slices do not say how to scale their values; they were taken as HU");
  else if (means_hu(slice.value_type))
    volume.warnings.push_back("the slices call their values '" + known_spelling_of_hu(slice.value_type) +
                              "'; this was taken as HU");
  else if (!slice.value_type.empty() && slice.value_type != "HU" && slice.value_type != "US")
    volume.warnings.push_back("the slices hold " + standard_term(slice.value_type) +
                              ", not HU; thresholds and densities will not fit");
}

std::string counted_slices(const SliceStack& stack) {
  return std::to_string(stack.slices.size()) + (stack.slices.size() == 1 ? " slice" : " slices");
}

}  // namespace

HuVolume read_dicom_folder(const fs::path& path, const ReadOptions& options, const Progress& progress) {
  check_exists(path);
  const DicomScan scan = scan_dicom(path, part_of(progress, 0.0, scanning_share));
  const Series& series = chosen(scan, options.series_uid, path);
  const SliceStack stack = stack_of(series.second, path.string());
  HuVolume volume;
  volume.warnings = scan.warnings;
  if (scan.series.size() > 1)
    volume.warnings.push_back("there are " + std::to_string(scan.series.size()) + " CT series; " +
                              (options.series_uid.empty() ? "the largest" : "the chosen one") +
                              " was taken, " + counted_slices(stack));
  volume.warnings.insert(volume.warnings.end(), stack.warnings.begin(), stack.warnings.end());
  load_stack(volume, stack, path.string(), options.max_bytes, part_of(progress, scanning_share, 1.0));
  const DicomSlice& first = stack.slices.front();
  warn_of_burnt_in(volume, stack.slices);
  warn_of_value_type(volume, first);
  warn_of_thickness(volume, first.spacing_mm.z());
  if (options.keep_names) volume.patient = first.patient;
  volume.source = "DICOM series of " + counted_slices(stack);
  return volume;
}

}  // namespace ream::reader
