#pragma once
#include <filesystem>
#include <string>
#include <string_view>

#include "geometry/triangle_mesh.hpp"

namespace ream {

/// An STL, OBJ, PLY, OFF or GLB file, all parts merged, vertices joined, in the
/// file's own coordinates (taken as mm). Throws Error: not_found; invalid_input for unreadable files, no
/// triangles, NaN or infinite vertices, indices out of range, cut-off files. Triangles with two equal corners
/// are dropped. PLY and OFF are read here, not by assimp.
TriangleMesh load_mesh(const std::filesystem::path& path);

/// The bytes of a binary little-endian PLY file with float positions and, where present, normals. `remark`
/// stands in its header as a comment: frame, unit and what it is, in one line.
std::string ply_of(const TriangleMesh& mesh, const std::string& remark = "millimetres");

/// Writes such a file atomically. Throws Error io.
void write_ply(const std::filesystem::path& path, const TriangleMesh& mesh,
               const std::string& remark = "millimetres");

/// Positions and faces of a PLY file's bytes (text, little- or big-endian; polygons become fans; other
/// properties and elements are passed over). Vertices and indices are as they stand in the file, unjoined;
/// indices are checked, positions are not. Read here because assimp's PLY reader hangs or crashes on files
/// that were cut off. Throws Error invalid_input naming `path` and what is wrong.
TriangleMesh parse_ply(std::string_view bytes, const std::filesystem::path& path);

}  // namespace ream
