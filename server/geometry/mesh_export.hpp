#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace ream {

/// Endings of the files that write_mesh() can write, with their dots.
const std::vector<std::string>& mesh_file_endings();
bool is_mesh_file_ending(const std::string& ending);

/// Writes a mesh atomically in the form that the ending of `path` says: .ply (binary, with `remark` in its
/// header), .stl (binary) or .glb (glTF 2; unlike the others in metres, as that form has it). Errors:
/// invalid_input for another ending; io.
void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh, const std::string& remark);

}  // namespace ream
