#pragma once
#include <filesystem>
#include <string_view>

#include "geometry/triangle_mesh.hpp"

namespace ream::reader {

/// The file of load_mesh(), read in this process. Errors: invalid_input.
TriangleMesh read_mesh_file(const std::filesystem::path& path);

/// Positions and faces of a PLY file's bytes (text, little- or big-endian; polygons become fans; other
/// properties and elements are passed over). Vertices and indices are as they stand in the file, unjoined;
/// indices are checked, positions are not. Read here because assimp's PLY reader hangs on files that were cut
/// off. Throws Error invalid_input naming `path` and what is wrong.
TriangleMesh parse_ply(std::string_view bytes, const std::filesystem::path& path);

/// The same of a text OFF file.
TriangleMesh parse_off(std::string_view text, const std::filesystem::path& path);

}  // namespace ream::reader
