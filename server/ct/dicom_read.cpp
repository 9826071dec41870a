#include <algorithm>

#include "core/error.hpp"
#include "ct/dicom_series.hpp"
#include "ct/slice_resample.hpp"
#include "ct/volume_io.hpp"
#include "ct/volume_remarks.hpp"

namespace ream::ct {
namespace fs = std::filesystem;
namespace {

constexpr double scanning_share = 0.2;  // looking at headers takes about a fifth of reading everything

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

void remark_values(HuVolume& volume, const DicomSlice& slice) {
  if (slice.value_type == "unscaled")
    volume.warnings.push_back("the slices do not say how to scale their values; they were taken as HU");
  else if (!slice.value_type.empty() && slice.value_type != "HU" && slice.value_type != "US")
    volume.warnings.push_back("the slices hold " + slice.value_type +
                              ", not HU; thresholds and densities will not fit");
}

SeriesSummary summary_of(const Series& series) {
  SeriesSummary summary;
  summary.uid = series.first;
  summary.description = series.second.front().description;
  summary.slices = static_cast<int>(series.second.size());
  summary.dims = {series.second.front().columns, series.second.front().rows, summary.slices};
  summary.spacing_mm = series.second.front().spacing_mm;
  try {
    const SliceStack stack = stack_of(series.second, "");
    summary.dims.z() = stack.count;
    summary.spacing_mm.z() = stack.distance_mm;
  } catch (const Error&) {
    // A series that cannot be read is listed all the same, as its headers describe it.
  }
  return summary;
}

}  // namespace

std::vector<SeriesSummary> list_series(const fs::path& path, const Progress& progress) {
  check_exists(path);
  std::vector<SeriesSummary> result;
  for (const Series& series : scan_dicom(path, progress).series) result.push_back(summary_of(series));
  std::stable_sort(result.begin(), result.end(),
                   [](const SeriesSummary& a, const SeriesSummary& b) { return a.slices > b.slices; });
  return result;
}

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
                              " was taken, " + std::to_string(stack.slices.size()) + " slices, UID " +
                              series.first);
  volume.warnings.insert(volume.warnings.end(), stack.warnings.begin(), stack.warnings.end());
  load_stack(volume, stack, path.string(), part_of(progress, scanning_share, 1.0));
  const DicomSlice& first = stack.slices.front();
  remark_values(volume, first);
  remark_thickness(volume, first.spacing_mm.z());
  if (options.keep_names) volume.patient = first.patient;
  volume.source = "DICOM series of " + std::to_string(stack.slices.size()) + " slices";
  return volume;
}

}  // namespace ream::ct
