#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "fe/node_numbering.hpp"

namespace ream::fe {

/// The planes that bound the elements, in corners of the grid: least and greatest along each axis.
struct MeshBounds {
  Vec3i least = Vec3i::Zero(), greatest = Vec3i::Zero();
};
/// Needs an element.
MeshBounds bounds_of(const VoxelMask& mask);

/// Faces in the order x least, x greatest, y least, and so on.
inline constexpr int face_count = 6;
inline constexpr std::array<const char*, face_count> face_names = {"XMIN", "XMAX", "YMIN",
                                                                   "YMAX", "ZMIN", "ZMAX"};

/// Calls visit(face, corner, id) for every node on a face of the bounds, by rising id.
void for_each_face_node(const NodeNumbering& numbering,
                        const std::function<void(int face, const Vec3i& corner, uint64_t id)>& visit);

/// Ids of the nodes on each face, rising.
std::array<std::vector<uint32_t>, face_count> face_nodes(const NodeNumbering& numbering);

}  // namespace ream::fe
