#include <gdcmTrace.h>
#include <itkGDCMImageIO.h>
#include <itkMetaDataObject.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.hpp"
#include "ct/dicom_completeness.hpp"
#include "ct/itk_volume.hpp"
#include "ct/volume_io.hpp"

namespace ream::ct {
namespace fs = std::filesystem;
namespace {

constexpr double orientation_tolerance = 1e-3;
constexpr double duplicate_mm = 0.01;
constexpr double max_gap_slices = 4.0;  // a wider gap is two scans, not a lost slice

struct Slice {
  fs::path file;
  ItkGeometry geometry;
  double position_mm = 0;  // along the slice normal

  Vec3 normal() const { return geometry.direction.col(0).cross(geometry.direction.col(1)); }
  bool fits(const Slice& o) const {
    return geometry.dims == o.geometry.dims &&
           (geometry.direction.leftCols<2>() - o.geometry.direction.leftCols<2>()).cwiseAbs().maxCoeff() <
               orientation_tolerance &&
           (geometry.spacing_mm - o.geometry.spacing_mm).head<2>().cwiseAbs().maxCoeff() <
               orientation_tolerance;
  }
};

using SeriesMap = std::map<std::string, std::vector<Slice>>;

std::string tag(const itk::ImageIOBase& io, const char* key) {
  std::string value;
  itk::ExposeMetaData<std::string>(io.GetMetaDataDictionary(), key, value);
  while (!value.empty() && (value.back() == ' ' || value.back() == '\0')) value.pop_back();
  return value;
}

Error unreadable(const fs::path& file, const itk::ExceptionObject& e) {
  return {ErrorKind::invalid_input,
          file.string() + " cannot be read, it may be cut short: " + short_reason(e)};
}

/// False for what is to be passed over, counted in `imageless` where it is DICOM; throws for a file cut
/// short.
bool holds_an_image(const fs::path& file, int& imageless) {
  const DicomState state = dicom_state(file);
  const bool named_dicom = file.extension() == ".dcm" || file.extension() == ".DCM";
  if (state == DicomState::cut_short || (state == DicomState::not_dicom && named_dicom))
    throw Error(ErrorKind::invalid_input,
                file.string() + " is cut short or not DICOM; copy it again from its source or take it away");
  if (state == DicomState::no_pixels) ++imageless;
  return state == DicomState::whole;
}

/// CT slices by series; other modalities and files that are not DICOM are passed over.
SeriesMap scan(const fs::path& folder, std::vector<std::string>& warnings) {
  std::vector<fs::path> files;
  for (const auto& entry :
       fs::recursive_directory_iterator(folder, fs::directory_options::skip_permission_denied))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  SeriesMap series;
  int imageless = 0;
  for (const fs::path& file : files) {
    if (!holds_an_image(file, imageless)) continue;
    const auto io = itk::GDCMImageIO::New();
    try {
      io->SetFileName(file.string());
      io->ReadImageInformation();
    } catch (const itk::ExceptionObject& e) {
      throw unreadable(file, e);
    }
    if (tag(*io, "0008|0060") != "CT") continue;
    Slice slice{file, geometry_of(*io), 0};
    if (slice.geometry.dims.z() != 1)
      throw Error(ErrorKind::invalid_input,
                  file.string() + " holds many slices in one file; convert it to NRRD first");
    series[tag(*io, "0020|000e")].push_back(std::move(slice));
  }
  if (imageless > 0)
    warnings.push_back(std::to_string(imageless) + " DICOM files without an image were passed over");
  return series;
}

/// Slices that share the orientation and size of most, sorted along the normal, without duplicates.
std::vector<Slice> consistent(const std::vector<Slice>& all, std::vector<std::string>& warnings) {
  size_t best = 0, best_count = 0;
  for (size_t i = 0; i < all.size() && best_count * 2 <= all.size(); ++i) {
    const auto count = static_cast<size_t>(
        std::count_if(all.begin(), all.end(), [&](const Slice& s) { return s.fits(all[i]); }));
    if (count > best_count) best = i, best_count = count;
  }
  std::vector<Slice> kept;
  const Vec3 normal = all[best].normal();
  for (Slice s : all) {
    if (!s.fits(all[best])) continue;
    s.position_mm = s.geometry.origin_mm.dot(normal);
    kept.push_back(std::move(s));
  }
  if (kept.size() < all.size())
    warnings.push_back(std::to_string(all.size() - kept.size()) +
                       " slices of another orientation or size were left out");
  std::stable_sort(kept.begin(), kept.end(),
                   [](const Slice& a, const Slice& b) { return a.position_mm < b.position_mm; });
  const size_t before = kept.size();
  kept.erase(std::unique(
                 kept.begin(), kept.end(),
                 [](const Slice& a, const Slice& b) { return b.position_mm - a.position_mm < duplicate_mm; }),
             kept.end());
  if (kept.size() < before)
    warnings.push_back(std::to_string(before - kept.size()) +
                       " slices at the place of another one were left out");
  return kept;
}

double usual_distance_mm(const std::vector<Slice>& slices) {
  std::vector<double> gaps;
  for (size_t i = 1; i < slices.size(); ++i)
    gaps.push_back(slices[i].position_mm - slices[i - 1].position_mm);
  std::nth_element(gaps.begin(), gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 2), gaps.end());
  return gaps[gaps.size() / 2];
}

void check_stack(const std::vector<Slice>& slices, const fs::path& folder) {
  const Vec3 normal = slices.front().normal();
  const Vec3 way = slices.back().geometry.origin_mm - slices.front().geometry.origin_mm;
  const double shear = (way - way.dot(normal) * normal).norm();
  if (shear > 0.5 * slices.front().geometry.spacing_mm.x())
    throw Error(ErrorKind::invalid_input,
                folder.string() +
                    ": the slices are shifted against each other (tilted gantry); resample the series first");
}

std::vector<int16_t> read_slice(const Slice& slice) {
  const auto io = itk::GDCMImageIO::New();
  try {
    io->SetFileName(slice.file.string());
    io->ReadImageInformation();
    return read_values(*io, slice.file.string());
  } catch (const itk::ExceptionObject& e) {
    throw unreadable(slice.file, e);
  }
}

/// Appends `slice` to the volume after the slices that are missing before it, mixed linearly from both sides.
void append(HuVolume& volume, const std::vector<int16_t>& slice, int missing) {
  const size_t size = slice.size();
  const size_t before = volume.hu.size() - (volume.hu.empty() ? 0 : size);
  for (int k = 1; k <= missing; ++k)
    for (size_t i = 0; i < size; ++i) {
      const double mix =
          volume.hu[before + i] + (slice[i] - volume.hu[before + i]) * static_cast<double>(k) / (missing + 1);
      volume.hu.push_back(static_cast<int16_t>(std::floor(mix + 0.5)));
    }
  volume.hu.insert(volume.hu.end(), slice.begin(), slice.end());
}

std::string rounded_mm(double v) { return std::to_string(std::lround(v)); }

void load_stack(HuVolume& volume, const std::vector<Slice>& slices, const fs::path& folder) {
  const double distance = usual_distance_mm(slices);
  ItkGeometry geometry = slices.front().geometry;
  geometry.direction.col(2) = slices.front().normal();
  geometry.spacing_mm.z() = distance;
  bool uneven = false;
  for (size_t i = 0; i < slices.size(); ++i) {
    int missing = 0;
    if (i > 0) {
      const double gap = slices[i].position_mm - slices[i - 1].position_mm;
      if (gap > max_gap_slices * distance)
        throw Error(ErrorKind::invalid_input, folder.string() + ": slices are missing between " +
                                                  rounded_mm(slices[i - 1].position_mm) + " and " +
                                                  rounded_mm(slices[i].position_mm) +
                                                  " mm; give a complete series");
      missing = std::max(0, static_cast<int>(std::lround(gap / distance)) - 1);
      uneven = uneven || std::abs(gap - (missing + 1) * distance) > 0.1 * distance;
      if (missing > 0)
        volume.warnings.push_back(std::to_string(missing) + " missing slices between " +
                                  rounded_mm(slices[i - 1].position_mm) + " and " +
                                  rounded_mm(slices[i].position_mm) + " mm were interpolated");
    }
    append(volume, read_slice(slices[i]), missing);
  }
  if (uneven)
    volume.warnings.push_back("the slices are not evenly spaced; the middle distance was used for all");
  const auto slice_size = static_cast<size_t>(geometry.dims.x()) * static_cast<size_t>(geometry.dims.y());
  geometry.dims.z() = static_cast<int>(volume.hu.size() / slice_size);
  set_geometry(volume, geometry, folder.string());
}

}  // namespace

HuVolume read_dicom_folder(const fs::path& folder) {
  if (!fs::is_directory(folder)) throw Error(ErrorKind::not_found, "no such folder: " + folder.string());
  itk::Object::GlobalWarningDisplayOff();
  gdcm::Trace::WarningOff();
  gdcm::Trace::ErrorOff();
  HuVolume volume;
  const SeriesMap all = scan(folder, volume.warnings);
  const auto largest = std::max_element(
      all.begin(), all.end(), [](const auto& a, const auto& b) { return a.second.size() < b.second.size(); });
  if (largest == all.end())
    throw Error(ErrorKind::invalid_input,
                folder.string() + " holds no CT slices (DICOM, modality CT); give the folder of a CT series");
  const auto slices = consistent(largest->second, volume.warnings);
  if (slices.size() < 2)
    throw Error(ErrorKind::invalid_input,
                folder.string() + " holds a single CT slice; a volume needs at least two");
  if (all.size() > 1)
    volume.warnings.push_back("the folder holds " + std::to_string(all.size()) +
                              " CT series; the largest was taken, " + std::to_string(slices.size()) +
                              " slices, UID " + largest->first);
  check_stack(slices, folder);
  load_stack(volume, slices, folder);
  volume.source = "DICOM series of " + std::to_string(slices.size()) + " slices";
  return volume;
}

}  // namespace ream::ct
