#pragma once
#include "geometry/triangle_mesh.hpp"
#include "voxel/voxel_grid.hpp"

namespace ream::ct {

/// Beside case.json where a case has what no CT of its own shows: what lies around its bone, LPS mm.
inline constexpr const char* surroundings_file = "surroundings.ply";

/// What of a bone's surface (world frame, outward normals) lies around a grid that holds a part of that bone:
/// pictures show it beside the part that is reamed, which the grid alone describes. Triangles that lie in the
/// grid's box with all corners are left out; those across its sides stay. Empty where the box holds all.
TriangleMesh surroundings_of(const TriangleMesh& bone_world, const voxel::VoxelGrid& grid);

}  // namespace ream::ct
