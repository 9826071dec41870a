#pragma once
#include <itkImageIOBase.h>

#include <filesystem>

namespace ream::ct {

/// Whether the name is that of a NRRD, NIfTI or MetaImage file.
bool is_volume_file(const std::filesystem::path& path);

/// The reader of such a file. Error invalid_input for other names, says which there are.
itk::ImageIOBase::Pointer image_io_for(const std::filesystem::path& path);

/// Refuses what has no three dimensions, no voxels or more than max_ct_voxels: Error invalid_input.
void check_dimensions(const itk::ImageIOBase& io, const std::string& place);

}  // namespace ream::ct
