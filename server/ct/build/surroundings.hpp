#pragma once
#include <filesystem>

#include "case/case.hpp"
#include "geometry/triangle_mesh.hpp"

namespace ream::ct {

/// Beside case.json where a case has what no CT of its own shows: what lies around its bone, LPS mm.
inline constexpr const char* surroundings_file = "surroundings.ply";

/// What of a bone's surface (world frame, outward normals) lies around the part that a case's grid holds:
/// pictures show it beside that part, which the grid alone describes. Triangles are left out that lie in the
/// grid's box (less a millimetre, so that no gap is seen along its sides), and those that a reamer on the
/// planned axis may come to, which would look as if it could not cut them. Empty where nothing is left.
TriangleMesh surroundings_of(const TriangleMesh& bone_world, const case_::Case& description);

/// What that file of a case's folder holds, with smooth normals; empty where there is none. Errors: those of
/// load_mesh.
TriangleMesh kept_surroundings(const std::filesystem::path& case_folder);

}  // namespace ream::ct
