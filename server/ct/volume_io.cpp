#include "ct/volume_io.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "ct/dicom_file.hpp"
#include "ct/file_completeness.hpp"
#include "ct/image_io.hpp"
#include "ct/itk_volume.hpp"
#include "ct/nrrd_order.hpp"
#include "ct/text_rows.hpp"
#include "ct/volume_claims.hpp"
#include "ct/volume_remarks.hpp"

namespace ream::ct {
namespace fs = std::filesystem;
namespace {

enum class Kind { volume, rows, dicom };

std::string ending_of(const fs::path& path) {
  const std::string name = path.filename().string();
  return name.ends_with(".nii.gz") ? ".nii.gz" : path.extension().string();
}

/// By the name's ending; a file without a known one may still be DICOM, whose names are anything.
Kind kind_of(const fs::path& path) {
  if (fs::is_directory(path)) return Kind::dicom;
  const std::string ending = ending_of(path);
  if (ending == ".txt" || ending == ".csv" || ending == ".xyz") return Kind::rows;
  if (ending == ".dcm" || ending == ".DCM") return Kind::dicom;
  if (is_volume_file(path)) return Kind::volume;
  return fs::is_regular_file(path) && dicom_state(path) != DicomState::not_dicom ? Kind::dicom : Kind::volume;
}

}  // namespace

HuVolume read_volume_file(const fs::path& path) {
  const std::string place = path.string();
  if (!fs::exists(path)) throw Error(ErrorKind::not_found, "no such file: " + place);
  const auto io = image_io_for(path);
  HuVolume volume;
  volume.warnings = check_claims(path);
  itk::Object::GlobalWarningDisplayOff();
  const OrderedNrrd readable(path);
  try {
    io->SetFileName(readable.path().string());
    io->ReadImageInformation();
    check_dimensions(*io, place);
    check_complete(path, static_cast<uint64_t>(io->GetImageSizeInBytes()));
    volume.hu = read_values(*io, place);
    set_geometry(volume, geometry_of(*io), place);
  } catch (const itk::ExceptionObject& e) {
    throw Error(ErrorKind::invalid_input, place + " cannot be read, it may be cut short: " + short_reason(e));
  } catch (const std::bad_alloc&) {
    throw Error(ErrorKind::invalid_input, place + " does not fit into memory");
  }
  volume.source = path.filename().string();
  return volume;
}

namespace {

HuVolume read_file(const fs::path& path, Kind kind, const ReadOptions& options, const Progress& progress) {
  HuVolume volume = kind == Kind::rows ? read_text_rows(path, progress) : read_volume_file(path);
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
  remark_gray_values(volume);
  remark_thickness(volume, 0.0);
  // A file's name may be a patient's.
  volume.source = kind == Kind::rows ? "text rows x y z gray" : "volume file (" + ending_of(path) + ")";
  if (options.keep_names) volume.source += " " + path.filename().string();
  progress(1.0, "reading slices");
  return volume;
}

}  // namespace

HuVolume read_ct(const fs::path& path, const ReadOptions& options, const Progress& progress) {
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

void write_volume_file(const HuVolume& volume, const fs::path& path) {
  const auto io = image_io_for(path);
  try {
    describe(*io, volume);
    io->SetUseCompression(true);
    io->SetFileName(path.string());
    io->WriteImageInformation();
    io->Write(volume.hu.data());
  } catch (const itk::ExceptionObject& e) {
    throw Error(ErrorKind::io, "cannot write " + path.string() + ": " + short_reason(e));
  }
}

}  // namespace ream::ct
