#pragma once
#include <map>

#include "core/progress.hpp"
#include "ct/dicom_slice.hpp"

namespace ream::ct {

/// The CT pictures found in a folder.
struct DicomScan {
  std::map<std::string, std::vector<DicomSlice>> series;  ///< by UID: what can be a slice of a volume
  std::vector<std::string> warnings;                      ///< what was passed over
  std::string first_refused;                              ///< file and reason, when a CT picture was
  std::string other_modalities;                           ///< such as "MR, PT"
};

/// Looks at every file below a folder, or at one file. Hidden files, files that are not DICOM and DICOM
/// without pictures are passed over. Errors: invalid_input (names the file) for a file that is cut short or
/// says impossible things; cancelled.
DicomScan scan_dicom(const std::filesystem::path& path, const Progress& progress);

}  // namespace ream::ct
