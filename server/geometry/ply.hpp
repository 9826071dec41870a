#pragma once
#include <filesystem>
#include <string_view>

#include "geometry/triangle_mesh.hpp"

namespace ream {

/// Positions and faces of a PLY file's bytes (text, little- or big-endian; polygons become fans; other
/// properties and elements are passed over). Vertices and indices are as they stand in the file, unjoined;
/// indices are checked, positions are not. Read here because assimp's PLY reader hangs or crashes on files
/// that were cut off. Throws Error invalid_input naming `path` and what is wrong.
TriangleMesh parse_ply(std::string_view bytes, const std::filesystem::path& path);

}  // namespace ream
