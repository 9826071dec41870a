#include "fe/mesh_faces.hpp"

#include "fe/corner_row.hpp"

namespace ream::fe {

MeshBounds bounds_of(const VoxelMask& mask) {
  const Vec3i& dims = mask.dims();
  MeshBounds bounds{dims, Vec3i::Zero()};
  for (int w = 0; w < dims.z(); ++w)
    for (int v = 0; v < dims.y(); ++v) {
      const uint64_t* row = mask.row(v, w);
      for (size_t i = 0; i < mask.words_per_row(); ++i) {
        if (row[i] == 0) continue;
        const int base = static_cast<int>(64 * i);
        bounds.least = bounds.least.cwiseMin(Vec3i(base + std::countr_zero(row[i]), v, w));
        bounds.greatest = bounds.greatest.cwiseMax(Vec3i(base + 64 - std::countl_zero(row[i]), v + 1, w + 1));
      }
    }
  return bounds;
}

void for_each_face_node(const NodeNumbering& numbering,
                        const std::function<void(int face, const Vec3i& corner, uint64_t id)>& visit) {
  const MeshBounds bounds = bounds_of(numbering.mask());
  const auto visit_row = [&](int v, int w, const CornerRow& row) {
    for (int side = 0; side < 2; ++side) {
      const Vec3i& plane = side == 0 ? bounds.least : bounds.greatest;
      if (row.has(plane.x())) visit(side, {plane.x(), v, w}, row.first_id() + row.rank(plane.x()));
      const bool on_y = v == plane.y(), on_z = w == plane.z();
      if (!on_y && !on_z) continue;
      uint64_t id = row.first_id();
      for_each_run(row.words().data(), row.words().size(), [&](int begin, int end) {
        for (int u = begin; u < end; ++u, ++id) {
          if (on_y) visit(2 + side, {u, v, w}, id);
          if (on_z) visit(4 + side, {u, v, w}, id);
        }
      });
    }
  };
  for (size_t slab = 0; slab < numbering.corners().count(); ++slab)
    for_each_corner_row(numbering, slab, visit_row);
}

std::array<std::vector<uint32_t>, face_count> face_nodes(const NodeNumbering& numbering) {
  std::array<std::vector<uint32_t>, face_count> nodes;
  for_each_face_node(numbering, [&](int face, const Vec3i&, uint64_t id) {
    nodes[static_cast<size_t>(face)].push_back(static_cast<uint32_t>(id));
  });
  return nodes;
}

}  // namespace ream::fe
