#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "ct/hu_volume.hpp"

namespace ream::ct {

/// What ream-reader says of a volume whose values it wrote to a file: everything of it but the values.
nlohmann::json answer_of(const HuVolume& volume);

/// The same on the other side. Every number is checked, as the process that read a file from outside is not
/// trusted: sides from 2 to 65,535 voxels (or from 1, `flat`), at most max_ct_voxels, positive sizes, a
/// rotation, finite. Throws Error io for what is none.
HuVolume volume_from(const nlohmann::json& answer, bool flat = false);

/// Of a volume of which not every voxel has a value, the reader writes a bit for each voxel, a layer in so
/// many 64-bit words, and the values of those that have one.
inline size_t given_words_per_layer(const Vec3i& dims) {
  return (static_cast<size_t>(dims.x()) * static_cast<size_t>(dims.y()) + 63) / 64;
}

/// Writes 16-bit values as this machine has them. Throws Error io.
void write_values(const std::filesystem::path& file, const void* values, size_t count);

}  // namespace ream::ct
