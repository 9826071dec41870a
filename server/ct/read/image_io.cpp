#include "ct/read/image_io.hpp"

#include <itkMetaImageIO.h>
#include <itkNiftiImageIO.h>
#include <itkNrrdImageIO.h>

#include <algorithm>

#include "core/error.hpp"
#include "ct/read/ct_file_names.hpp"

namespace ream::ct {
namespace fs = std::filesystem;

itk::ImageIOBase::Pointer image_io_for(const fs::path& path) {
  const std::string ending = ct_file_ending(path);
  if (ending == ".nrrd" || ending == ".nhdr") return itk::NrrdImageIO::New().GetPointer();
  if (ending == ".nii" || ending == ".nii.gz") return itk::NiftiImageIO::New().GetPointer();
  if (ending == ".mha" || ending == ".mhd") return itk::MetaImageIO::New().GetPointer();
  throw Error(ErrorKind::invalid_input,
              path.string() +
                  " is not a volume that can be read; give a folder of DICOM slices or a .nrrd, "
                  ".nii, .nii.gz, .mha, .mhd or .txt (rows x y z gray) file");
}

std::string short_reason(const itk::ExceptionObject& e) {
  std::string text = e.GetDescription();
  const auto colon = text.find("): ");
  if (colon != std::string::npos) text = text.substr(colon + 3);
  std::replace(text.begin(), text.end(), '\n', ' ');
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

}  // namespace ream::ct
