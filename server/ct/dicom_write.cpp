#include <gdcmTrace.h>
#include <itkGDCMImageIO.h>
#include <itkMetaDataObject.h>

#include <cstdio>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "ct/itk_volume.hpp"
#include "ct/volume_io.hpp"

namespace ream::ct {
namespace {

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

void write_dicom_folder(const HuVolume& volume, const std::filesystem::path& folder, uint64_t seed) {
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

}  // namespace ream::ct
