#pragma once
#include <filesystem>
#include <string_view>

#include "geometry/triangle_mesh.hpp"

namespace ream {

/// Positions and faces of an OFF file's text (also COFF and NOFF, whose further numbers are passed over;
/// polygons become fans). Vertices and indices are as they stand in the file; indices are checked, positions
/// are not. Throws Error invalid_input naming `path` and what is wrong.
TriangleMesh parse_off(std::string_view text, const std::filesystem::path& path);

}  // namespace ream
