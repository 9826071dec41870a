#pragma once
#include <filesystem>

#include "case/plan.hpp"
#include "ct/build/ct_workspace.hpp"
#include "geometry/triangle_mesh.hpp"

namespace ream::ct {

/// Beside case.json: what lies around the bone of the case, LPS mm, for pictures. It is of the same
/// segmentation as the bone.
inline constexpr const char* surroundings_file = "surroundings.ply";

/// What of a bone's surface (world frame, outward normals) lies around the part that a grid holds: triangles
/// are left out that lie in the grid's box with all corners (less a millimetre). Along its sides what is left
/// stands out by up to a quarter of a millimetre, and so covers the seam. Empty where the box holds all.
TriangleMesh surroundings_of(const TriangleMesh& bone_world, const voxel::VoxelGrid& grid);

/// The same of the segmented scapula of a CT, at the CT's resolution or half of it. Error conflict without
/// one.
TriangleMesh scapula_around(const Workup& workup, const std::vector<int16_t>& hu,
                            const std::vector<uint8_t>& labels, const voxel::VoxelGrid& grid);

/// Without triangles in the grid's box that a reamer on the planned axis may come to, which would look as if
/// it could not cut them: the grid alone describes what is there.
TriangleMesh beyond_reach(const TriangleMesh& around, const case_::Plan& plan, const voxel::VoxelGrid& grid);

/// Writes the file of a case's folder, or removes it where nothing lies around. Throws Error io.
void keep_surroundings(const TriangleMesh& around, case_::Side side,
                       const std::filesystem::path& case_folder);

/// What that file holds, with smooth normals; empty where there is none, or, with a warning in the log, where
/// it is damaged.
TriangleMesh kept_surroundings(const std::filesystem::path& case_folder);

}  // namespace ream::ct
