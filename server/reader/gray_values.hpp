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

}  // namespace ream::reader
