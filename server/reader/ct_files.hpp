#pragma once
#include "ct/read/read_ct.hpp"

namespace ream::reader {

using ct::HuVolume, ct::ReadOptions, ct::PatientNames, ct::max_ct_voxels, ct::min_hu;

/// A CT as ct::read_ct describes it, but for zip archives, read in this process. Errors: those of
/// ct::read_ct.
HuVolume read_ct_files(const std::filesystem::path& path, const ReadOptions& options = {},
                       const Progress& progress = no_progress);

/// One NRRD, NIfTI or MetaImage file, values clamped to 16 bits but otherwise as they are (label maps). One
/// that makes a volume of more than `max_bytes` is refused by its header, before memory is taken for it.
HuVolume read_volume_file(const std::filesystem::path& path, uint64_t max_bytes = ReadOptions{}.max_bytes);

/// Throws Error invalid_input when the HU of a volume, of which only the size need be known, take more than
/// `max_bytes`. `name` is that of the file in errors.
void check_bytes(const HuVolume& volume, uint64_t max_bytes, const std::string& name);

/// Whether a file is DICOM, by its content; a damaged one is.
bool is_dicom(const std::filesystem::path& file);

/// A CT series under a folder, or the frames of one DICOM file, slices sorted along their normal. Repaired,
/// each with a warning: up to three missing slices in a row are interpolated; uneven slices are resampled
/// linearly at the median distance; slices sheared by a tilted gantry are resampled on an orthogonal grid;
/// localizers, colour pictures, slices of another orientation or size, stray ones, duplicates and further
/// series are left out; padding becomes air. Any transfer syntax of GDCM. Errors as read_ct.
HuVolume read_dicom_folder(const std::filesystem::path& path, const ReadOptions& options = {},
                           const Progress& progress = no_progress);

/// Reads the thesis' text rows: `x y z gray` a line, one line a voxel of a regular grid, in any order.
/// Blanks, tabs, commas or semicolons between; empty lines and those that begin with # are passed over. x y z
/// are the voxel centres in LPS mm, or voxel indices: whole numbers from 0 without a gap, taken as voxels of
/// 1 mm unless a line `# spacing_mm X Y Z` stands before the rows; gray is rounded to a whole number and
/// clamped to 16 bits. The file is read twice in pieces; memory is the volume and one bit a voxel. Errors:
/// invalid_input naming the file and the line (no four numbers, a voxel off the grid or given twice, a voxel
/// missing), not_found, io, cancelled.
HuVolume read_text_rows(const std::filesystem::path& path, const Progress& progress = no_progress);

/// From this slice distance or thickness on, a CT is too coarse for a plan.
inline constexpr double thick_slice_mm = 5.0;

/// Warns of thick slices and says what they cost (measured: tests/unit/ct/thick_slices_test.cpp).
/// `thickness_mm` is what the file says of its slices, 0 when it says nothing.
void warn_of_thickness(HuVolume& volume, double thickness_mm);

}  // namespace ream::reader
