#pragma once
#include <filesystem>
#include <string>

#include "geometry/triangle_mesh.hpp"

namespace ream {

/// An STL, OBJ, PLY, OFF or GLB file, all parts merged, vertices joined, in the file's own coordinates (taken
/// as mm); read by ream-reader. Throws Error: not_found; invalid_input for unreadable files, no triangles,
/// NaN or infinite vertices, indices out of range, cut-off files. Triangles with two equal corners are
/// dropped.
TriangleMesh load_mesh(const std::filesystem::path& path);

/// The bytes of a binary little-endian PLY file with float positions and, where present, normals. `remark`
/// stands in its header as a comment: frame, unit and what it is, in one line.
std::string ply_of(const TriangleMesh& mesh, const std::string& remark = "millimetres");

/// Writes such a file atomically. Throws Error io.
void write_ply(const std::filesystem::path& path, const TriangleMesh& mesh,
               const std::string& remark = "millimetres");

}  // namespace ream
