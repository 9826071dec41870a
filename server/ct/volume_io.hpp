#pragma once
#include <filesystem>

#include "core/progress.hpp"
#include "ct/hu_volume.hpp"

namespace ream::ct {

struct ReadOptions {
  std::string series_uid;   ///< of several DICOM series the one with this UID; empty: the one of most slices
  bool keep_names = false;  ///< keep the patient's name and id, and a volume file's name in `source`
};

/// Reads a CT: a folder of DICOM slices (or one DICOM file of many), one NRRD, NIfTI or MetaImage file (.nrrd
/// .nhdr .nii .nii.gz .mha .mhd) of any integer or float voxels and any orthogonal orientation, or a text
/// file of rows `x y z gray` (text_rows.hpp). World is LPS mm whatever the file's own convention; a
/// left-handed volume is turned right-handed by reversing its last axis. Values below min_hu become min_hu.
/// What was odd or repaired is in `warnings`, in plain words. A file's claims are held against its size
/// before memory is taken, and a CT has at most max_ct_voxels. Errors: not_found, invalid_input (names the
/// file and the reason), cancelled by `progress`; one line each.
HuVolume read_ct(const std::filesystem::path& path, const ReadOptions& options = {},
                 const Progress& progress = no_progress);

inline constexpr double max_ct_voxels = 1.0e9;  ///< 2 GB of HU; a clinical CT has up to 5e8

/// One NRRD, NIfTI or MetaImage file, values clamped to 16 bits but otherwise as they are (label maps).
HuVolume read_volume_file(const std::filesystem::path& path);

/// Writes HU as 16-bit NRRD, NIfTI or MetaImage by the file's extension. Not atomic: write into a folder in
/// progress. Throws Error io.
void write_volume_file(const HuVolume& volume, const std::filesystem::path& path);

/// A CT series in a folder, without names.
struct SeriesSummary {
  std::string uid, description;
  int slices = 0;  ///< usable as CT slices
  Vec3i dims = Vec3i::Zero();
  Vec3 spacing_mm = Vec3::Ones();  ///< between slices the usual distance
};

/// The CT series under a folder (or in one DICOM file), most slices first; read_ct takes the first unless
/// told otherwise. Empty when there is none. Errors as read_ct.
std::vector<SeriesSummary> list_series(const std::filesystem::path& path,
                                       const Progress& progress = no_progress);

/// A CT series under a folder, or the frames of one DICOM file, slices sorted along their normal. Repaired,
/// each with a warning: up to three missing slices in a row are interpolated; uneven slices are resampled
/// linearly at the median distance; slices sheared by a tilted gantry are resampled on an orthogonal grid;
/// localizers, colour pictures, slices of another orientation or size, stray ones, duplicates and further
/// series are left out; padding becomes air. Any transfer syntax of GDCM. Errors as read_ct.
HuVolume read_dicom_folder(const std::filesystem::path& path, const ReadOptions& options = {},
                           const Progress& progress = no_progress);

/// One CT slice a file, slice_0001.dcm and so on; identifiers follow from `seed` alone, so equal volumes give
/// equal series. Throws Error io.
void write_dicom_folder(const HuVolume& volume, const std::filesystem::path& folder, uint64_t seed);

}  // namespace ream::ct
