#include "reader/ct_files.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "core/error.hpp"
#include "ct/read/ct_file_names.hpp"
#include "reader/dicom_file.hpp"
#include "reader/volume_file.hpp"

namespace ream::reader {
namespace fs = std::filesystem;
namespace {

constexpr int sampled_rows = 512;
constexpr int64_t smoother_factor = 4;
constexpr int64_t suspicious_step = 100;  // mean step between neighbours, of which no CT comes near

using Kind = ct::CtFileKind;

/// By the name's ending; a file without a known one may still be DICOM, whose names are anything.
Kind kind_of(const fs::path& path) {
  if (fs::is_directory(path)) return Kind::dicom;
  const Kind kind = ct::kind_by_name(path);
  const bool named = kind == Kind::volume || kind == Kind::rows || kind == Kind::dicom;
  return named || !fs::is_regular_file(path) || !is_dicom(path) ? kind : Kind::dicom;
}

/// Warns when the values cannot be HU: eight bits without a sign, or air near 0 and soft tissue near 1000.
void warn_of_gray_values(HuVolume& volume) {
  if (volume.hu.empty()) return;
  const auto [low, high] = std::minmax_element(volume.hu.begin(), volume.hu.end());
  if (*low < 0) return;
  if (*high <= 255) {
    volume.warnings.push_back("the values run from " + std::to_string(*low) + " to " + std::to_string(*high) +
                              ": these are gray values, not HU; threshold and calibration must be chosen for "
                              "them");
    return;
  }
  // Air near 0 and soft tissue near 1000 in one volume.
  const auto count = [&](int from, int to) {
    const auto n =
        std::count_if(volume.hu.begin(), volume.hu.end(), [&](int16_t v) { return v >= from && v < to; });
    return static_cast<double>(n) / static_cast<double>(volume.hu.size());
  };
  if (count(0, 200) > 0.05 && count(900, 1200) > 0.05)
    volume.warnings.push_back(
        "the values look like HU raised by about 1024 (air at 0, soft tissue at 1000); export the CT again "
        "with "
        "its rescaling, or choose threshold and calibration for them");
}

/// True when neighbours along x are far more alike after the two bytes of each value are swapped.
bool looks_byte_swapped(const HuVolume& volume) {
  const int64_t rows = static_cast<int64_t>(volume.dims.y()) * volume.dims.z(), width = volume.dims.x();
  const int64_t stride = std::max<int64_t>(1, rows / sampled_rows);
  int64_t as_is = 0, swapped = 0, steps = 0;
  const auto turned = [](int16_t v) {
    const auto bits = static_cast<uint16_t>(v);
    return static_cast<int16_t>(static_cast<uint16_t>(bits << 8 | bits >> 8));
  };
  for (int64_t row = 0; row < rows; row += stride)
    for (int64_t u = 1; u < width; ++u) {
      const int16_t a = volume.hu[static_cast<size_t>(row * width + u - 1)],
                    b = volume.hu[static_cast<size_t>(row * width + u)];
      as_is += std::abs(a - b);
      swapped += std::abs(turned(a) - turned(b));
      ++steps;
    }
  return steps > 0 && as_is > suspicious_step * steps && as_is > smoother_factor * swapped;
}

HuVolume read_file(const fs::path& path, Kind kind, const ReadOptions& options, const Progress& progress) {
  HuVolume volume =
      kind == Kind::rows ? read_text_rows(path, progress) : read_volume_file(path, options.max_bytes);
  check_bytes(volume, options.max_bytes, path.string());
  if (volume.dims.minCoeff() < 2)
    throw Error(ErrorKind::invalid_input,
                path.string() + " is a single slice; a volume needs at least two along every axis");
  if (looks_byte_swapped(volume))
    throw Error(ErrorKind::invalid_input, path.string() +
                                              ": the two bytes of each value are swapped; correct the byte "
                                              "order in its header");
  size_t outside = 0;
  for (int16_t& hu : volume.hu)
    if (hu < min_hu) hu = min_hu, ++outside;
  if (outside > 0)
    volume.warnings.push_back(
        std::to_string(outside) +
        " voxels below -1024 HU (outside the scanner's field of view) were taken as air");
  warn_of_gray_values(volume);
  warn_of_thickness(volume, 0.0);
  // A file's name may be a patient's.
  volume.source =
      kind == Kind::rows ? "text rows x y z gray" : "volume file (" + ct::ct_file_ending(path) + ")";
  if (options.keep_names) volume.source += " " + path.filename().string();
  progress(1.0, "reading slices");
  return volume;
}

}  // namespace

void check_bytes(const HuVolume& volume, uint64_t max_bytes, const std::string& name) {
  constexpr uint64_t megabyte = 1'000'000;
  const uint64_t bytes = sizeof(int16_t) * volume.voxel_count();
  if (bytes > max_bytes)
    throw Error(ErrorKind::invalid_input, name + " unpacks to a volume of " +
                                              std::to_string(bytes / megabyte) +
                                              " MB; of a file of this size at most " +
                                              std::to_string(max_bytes / megabyte) + " MB are taken");
}

void warn_of_thickness(HuVolume& volume, double thickness_mm) {
  const double thickest = std::max(volume.spacing_mm.maxCoeff(), thickness_mm);
  if (thickest < thick_slice_mm) return;
  // Worst of 12 phantoms, as thick_slices_test.cpp measures them.
  const bool coarse = thickest > 6.5;
  const char* inclination = coarse ? "4.5" : "3.6";
  const char* merged = coarse ? "half" : "a quarter";
  char text[400];
  std::snprintf(
      text, sizeof text,
      "the slices are %.3g mm thick: phantoms of %s mm had the glenoid's face up to 2 mm off in depth and "
      "%s degrees in inclination, and up to %s of it ran together with the humerus (1 mm slices: 0.7 mm "
      "and 0.5 degrees); version stays within 0.6 degrees; plan on slices of 1.25 mm or finer",
      thickest, coarse ? "8" : "5", inclination, merged);
  volume.warnings.emplace_back(text);
}

HuVolume read_ct_files(const fs::path& path, const ReadOptions& options, const Progress& progress) {
  std::error_code failed;
  if (!fs::exists(path, failed))
    throw Error(ErrorKind::not_found, "no such file or folder: " + path.string());
  progress(0.0, "reading slices");
  try {
    const Kind kind = kind_of(path);
    return kind == Kind::dicom ? read_dicom_folder(path, options, progress)
                               : read_file(path, kind, options, progress);
  } catch (const std::bad_alloc&) {
    throw Error(ErrorKind::invalid_input, path.string() + " does not fit into memory");
  } catch (const fs::filesystem_error& e) {
    throw Error(ErrorKind::io, "cannot read " + path.string() + ": " + e.code().message());
  }
}

bool is_dicom(const fs::path& file) { return parse_dicom(file).state != DicomState::not_dicom; }

}  // namespace ream::reader
