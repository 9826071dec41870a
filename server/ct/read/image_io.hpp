#pragma once
#include <itkImageIOBase.h>

#include <filesystem>
#include <string>

namespace ream::ct {

/// The library's reader and writer of such a file. Error invalid_input for other names, says which there are.
/// Only ream-reader reads with it.
itk::ImageIOBase::Pointer image_io_for(const std::filesystem::path& path);

/// First sentence of an ITK exception, without its source place and line breaks.
std::string short_reason(const itk::ExceptionObject& e);

}  // namespace ream::ct
