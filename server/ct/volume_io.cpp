#include "ct/volume_io.hpp"

#include <itkMetaImageIO.h>
#include <itkNiftiImageIO.h>
#include <itkNrrdImageIO.h>

#include <algorithm>

#include "core/error.hpp"
#include "ct/file_completeness.hpp"
#include "ct/itk_volume.hpp"

namespace ream::ct {
namespace fs = std::filesystem;
namespace {

constexpr double max_voxels = 4.0e9;

itk::ImageIOBase::Pointer io_for(const fs::path& path) {
  const std::string name = path.filename().string();
  const auto ends = [&](const char* ending) { return name.ends_with(ending); };
  if (ends(".nrrd") || ends(".nhdr")) return itk::NrrdImageIO::New().GetPointer();
  if (ends(".nii") || ends(".nii.gz")) return itk::NiftiImageIO::New().GetPointer();
  if (ends(".mha") || ends(".mhd")) return itk::MetaImageIO::New().GetPointer();
  throw Error(ErrorKind::invalid_input,
              path.string() +
                  " is not a volume that can be read; give a folder of DICOM slices or a .nrrd, "
                  ".nii, .nii.gz, .mha or .mhd file");
}

void check_dimensions(const itk::ImageIOBase& io, const std::string& place) {
  double voxels = 1.0;
  for (unsigned axis = 0; axis < io.GetNumberOfDimensions(); ++axis) {
    voxels *= static_cast<double>(io.GetDimensions(axis));
    if (axis >= 3 && io.GetDimensions(axis) != 1)
      throw Error(ErrorKind::invalid_input, place + " has more than three dimensions; a CT has three");
  }
  if (io.GetNumberOfDimensions() < 3)
    throw Error(ErrorKind::invalid_input, place + " is a flat image; a CT has three dimensions");
  if (!(voxels >= 1.0)) throw Error(ErrorKind::invalid_input, place + " has a side of zero voxels");
  if (voxels > max_voxels) throw Error(ErrorKind::invalid_input, place + " has more than 4e9 voxels");
}

}  // namespace

HuVolume read_volume_file(const fs::path& path) {
  const std::string place = path.string();
  if (!fs::exists(path)) throw Error(ErrorKind::not_found, "no such file: " + place);
  const auto io = io_for(path);
  itk::Object::GlobalWarningDisplayOff();
  HuVolume volume;
  try {
    io->SetFileName(place);
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

HuVolume read_ct(const fs::path& path) {
  if (!fs::exists(path)) throw Error(ErrorKind::not_found, "no such file or folder: " + path.string());
  HuVolume volume = fs::is_directory(path) ? read_dicom_folder(path) : read_volume_file(path);
  size_t padding = 0;
  for (int16_t& hu : volume.hu)
    if (hu < min_hu) hu = min_hu, ++padding;
  if (padding > 0)
    volume.warnings.push_back(
        std::to_string(padding) +
        " voxels below -1024 HU (outside the scanner's field of view) were taken as air");
  return volume;
}

void write_volume_file(const HuVolume& volume, const fs::path& path) {
  const auto io = io_for(path);
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
