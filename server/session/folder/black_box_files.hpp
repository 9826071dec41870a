#pragma once
#include <filesystem>
#include <vector>

#include "sim/black_box.hpp"

namespace ream::session {

/// A session's folder keeps this many black boxes, of the newest faults.
inline constexpr size_t max_black_boxes = 8;

/// Writes the last seconds before `tick` to black-box-<tick>.csv in the folder, and removes the oldest where
/// there would be too many. Returns the path. Error io.
std::filesystem::path write_black_box(const sim::BlackBox& box, const std::filesystem::path& folder,
                                      uint32_t tick);

/// Those in a folder, oldest first.
std::vector<std::filesystem::path> black_boxes_in(const std::filesystem::path& folder);

}  // namespace ream::session
