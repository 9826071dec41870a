#pragma once
#include <filesystem>

namespace ream::ct {

enum class DicomState {
  not_dicom,  ///< no DICOM marker, and no bare data set either
  no_pixels,  ///< whole, but without an image
  whole,      ///< everything up to and with the pixel data is there
  cut_short,  ///< an element goes on behind the end of the file
};

/// Walks the file's data elements (DICOM PS3.5) without looking into them. Needed because the reading library
/// takes missing pixels for zeros and ends the program on some cut-off headers. Deflated
/// files, retired for CT, pass as whole.
DicomState dicom_state(const std::filesystem::path& file);

}  // namespace ream::ct
