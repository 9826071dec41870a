#pragma once
#include <filesystem>

#include "core/progress.hpp"
#include "ct/hu_volume.hpp"
#include "voxel/gray_scale.hpp"

namespace ream::reader {

/// A volume of gray values that need not be HU, without its values.
struct GrayValues {
  ct::HuVolume place;
  voxel::GrayScale gray;
};

/// Writes the codes of all voxels, layer by layer, to `values`. Layers that lie unpacked in the file are read
/// one by one, everything else whole, unless that takes more than `max_bytes` of memory. Errors: those of
/// read_ct_files; invalid_input that says what to do where it would take more.
GrayValues write_gray_values(const std::filesystem::path& path, const std::filesystem::path& values,
                             uint64_t max_bytes, const Progress& progress);

/// The same of text rows, which need not give every voxel: a bit for each voxel (ct::given_words_per_layer)
/// to `given`, the codes of those that have a row to `values`. Memory is 12 bytes a row, the bits, and the
/// codes of a few layers; what `max_bytes` has no room for goes to the disk. On two threads. Errors as
/// read_text_rows, but for missing voxels.
GrayValues write_row_values(const std::filesystem::path& path, const std::filesystem::path& given,
                            const std::filesystem::path& values, uint64_t max_bytes,
                            const Progress& progress);

}  // namespace ream::reader
