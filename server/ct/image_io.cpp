#include "ct/image_io.hpp"

#include <itkMetaImageIO.h>
#include <itkNiftiImageIO.h>
#include <itkNrrdImageIO.h>

#include "core/error.hpp"
#include "ct/volume_io.hpp"

namespace ream::ct {
namespace fs = std::filesystem;

bool is_volume_file(const fs::path& path) {
  const std::string name = path.filename().string();
  for (const char* ending : {".nrrd", ".nhdr", ".nii", ".nii.gz", ".mha", ".mhd"})
    if (name.ends_with(ending)) return fs::is_regular_file(path);
  return false;
}

itk::ImageIOBase::Pointer image_io_for(const fs::path& path) {
  const std::string name = path.filename().string();
  const auto ends = [&](const char* ending) { return name.ends_with(ending); };
  if (ends(".nrrd") || ends(".nhdr")) return itk::NrrdImageIO::New().GetPointer();
  if (ends(".nii") || ends(".nii.gz")) return itk::NiftiImageIO::New().GetPointer();
  if (ends(".mha") || ends(".mhd")) return itk::MetaImageIO::New().GetPointer();
  throw Error(ErrorKind::invalid_input,
              path.string() +
                  " is not a volume that can be read; give a folder of DICOM slices or a .nrrd, "
                  ".nii, .nii.gz, .mha, .mhd or .txt (rows x y z gray) file");
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
  if (voxels > max_ct_voxels) throw Error(ErrorKind::invalid_input, place + " has more than 1e9 voxels");
}

}  // namespace ream::ct
