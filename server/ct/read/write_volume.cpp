#include "ct/read/write_volume.hpp"

#include <gdcmTrace.h>
#include <itkGDCMImageIO.h>
#include <itkMetaDataObject.h>

#include <cstdio>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/hash.hpp"
#include "ct/read/image_io.hpp"

namespace ream::ct {
namespace fs = std::filesystem;
namespace {

/// Prepares `io` to write the volume as 16-bit scalars.
void describe(itk::ImageIOBase& io, const HuVolume& volume) {
  const Vec3 origin = volume.world_of_centre(Vec3i::Zero());
  itk::ImageIORegion region(3);
  io.SetNumberOfDimensions(3);
  for (unsigned axis = 0; axis < 3; ++axis) {
    io.SetDimensions(axis, static_cast<unsigned>(volume.dims[axis]));
    io.SetSpacing(axis, volume.spacing_mm[axis]);
    io.SetOrigin(axis, origin[axis]);
    const Vec3 column = volume.world_from_volume.rotation.col(axis);
    io.SetDirection(axis, std::vector<double>{column.x(), column.y(), column.z()});
    region.SetSize(axis, static_cast<unsigned long>(volume.dims[axis]));
  }
  io.SetIORegion(region);
  io.SetPixelType(itk::IOPixelEnum::SCALAR);
  io.SetComponentType(itk::IOComponentEnum::SHORT);
  io.SetNumberOfComponents(1);
}

itk::ImageIOBase::Pointer io_for_labels(const fs::path& path) {
  const std::string name = path.filename().string();
  if (name.ends_with(".nrrd") || name.ends_with(".nii") || name.ends_with(".nii.gz"))
    return image_io_for(path);
  throw Error(ErrorKind::invalid_input,
              path.string() + ": labels are written as .nrrd, .nii or .nii.gz; choose one of these endings");
}

/// A UID of the free 2.25 root (a whole number of up to 39 digits).
std::string uid(uint64_t seed, uint64_t what) {
  return "2.25." + std::to_string(1 + hash_combine(seed, what) / 2) +
         std::to_string(1000 + mix64(seed ^ what) % 9000);
}

/// A decimal string has at most 16 characters.
std::string decimal(double v) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", v + 0.0);
  return text;
}

std::string joined(std::initializer_list<double> values) {
  std::string text;
  for (const double v : values) text += (text.empty() ? "" : "\\") + decimal(v);
  return text;
}

/// Tags in the order of the standard; times are fixed so that equal volumes give equal files.
std::vector<std::pair<const char*, std::string>> tags(const HuVolume& volume, int slice, uint64_t seed) {
  const Mat3& r = volume.world_from_volume.rotation;
  const Vec3 p = volume.world_of_centre({0, 0, slice});
  return {{"0008|0008", "DERIVED\\SECONDARY\\AXIAL"},
          {"0008|0016", "1.2.840.10008.5.1.4.1.1.2"},
          {"0008|0018", uid(seed, 1000 + static_cast<uint64_t>(slice))},
          {"0008|0020", "20260101"},
          {"0008|0030", "120000"},
          {"0008|0060", "CT"},
          {"0008|0070", "ream"},
          {"0008|1030", "Phantom shoulder"},
          {"0008|103e", "Phantom shoulder"},
          {"0010|0010", "PHANTOM^SHOULDER"},
          {"0010|0020", "PHANTOM"},
          {"0018|0050", decimal(volume.spacing_mm.z())},
          {"0018|0060", "120"},
          {"0018|5100", "HFS"},
          {"0020|000d", uid(seed, 1)},
          {"0020|000e", uid(seed, 2)},
          {"0020|0011", "1"},
          {"0020|0013", std::to_string(slice + 1)},
          {"0020|0032", joined({p.x(), p.y(), p.z()})},
          {"0020|0037", joined({r(0, 0), r(1, 0), r(2, 0), r(0, 1), r(1, 1), r(2, 1)})},
          {"0020|0052", uid(seed, 3)},
          {"0028|1050", "400"},
          {"0028|1051", "1800"},
          {"0028|1052", "0"},
          {"0028|1053", "1"}};
}

}  // namespace

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

void write_dicom_folder(const HuVolume& volume, const fs::path& folder, uint64_t seed) {
  gdcm::Trace::WarningOff();
  const size_t slice_size = static_cast<size_t>(volume.dims.x()) * static_cast<size_t>(volume.dims.y());
  for (int w = 0; w < volume.dims.z(); ++w) {
    char name[32];
    std::snprintf(name, sizeof name, "slice_%04d.dcm", w + 1);
    const std::string file = (folder / name).string();
    const auto io = itk::GDCMImageIO::New();
    HuVolume slice;
    slice.dims = {volume.dims.x(), volume.dims.y(), 1};
    slice.spacing_mm = volume.spacing_mm;
    slice.world_from_volume = volume.world_from_volume;
    slice.world_from_volume.translation_mm =
        volume.world_from_volume.point({0, 0, w * volume.spacing_mm.z()});
    try {
      describe(*io, slice);
      io->KeepOriginalUIDOn();
      for (const auto& [key, value] : tags(volume, w, seed))
        itk::EncapsulateMetaData<std::string>(io->GetMetaDataDictionary(), key, value);
      io->SetFileName(file);
      io->WriteImageInformation();
      io->Write(volume.hu.data() + static_cast<size_t>(w) * slice_size);
    } catch (const itk::ExceptionObject& e) {
      throw Error(ErrorKind::io, "cannot write " + file + ": " + short_reason(e));
    }
  }
}

void write_label_map(const HuVolume& ct, const std::vector<uint8_t>& labels, const fs::path& path) {
  if (labels.size() != ct.voxel_count())
    throw Error(ErrorKind::invalid_input, "there is not one label per voxel of the CT");
  const auto io = io_for_labels(path);
  // Beside it and with its ending, which tells the format; renamed when it is whole.
  const fs::path unfinished = path.parent_path() / ("unfinished-" + path.filename().string());
  try {
    describe(*io, ct);
    io->SetComponentType(itk::IOComponentEnum::UCHAR);
    io->SetUseCompression(true);
    io->SetFileName(unfinished.string());
    io->WriteImageInformation();
    io->Write(labels.data());
    sync_file(unfinished);
    fs::rename(unfinished, path);
    sync_folder(path.parent_path());
  } catch (const itk::ExceptionObject& e) {
    std::error_code ignored;
    fs::remove(unfinished, ignored);
    throw Error(ErrorKind::io, "cannot write " + path.string() + ": " + short_reason(e));
  } catch (const fs::filesystem_error& e) {
    throw Error(ErrorKind::io, "cannot write " + path.string() + ": " + e.code().message());
  }
}

}  // namespace ream::ct
