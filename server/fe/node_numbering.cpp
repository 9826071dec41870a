#include "fe/node_numbering.hpp"

#include <numeric>
#include <string>

#include "core/error.hpp"
#include "core/thread_pool.hpp"

namespace ream::fe {
namespace {

/// Counts of slabs to sums before them; one more at the end with the whole.
void sum_up(std::vector<uint64_t>& counts) {
  counts.push_back(0);
  std::exclusive_scan(counts.begin(), counts.end(), counts.begin(), uint64_t{0});
}

}  // namespace

NodeNumbering::NodeNumbering(const VoxelMask& mask)
    : mask_(mask),
      voxels_(voxel_slabs(mask)),
      corners_(corner_slabs(mask)),
      elements_before_(voxels_.count()),
      nodes_before_(corners_.count()) {
  const size_t words = mask.words_per_row();
  parallel_for(2, corners_.per_layer() > 0 ? static_cast<size_t>(corners_.layers) : 0, [&](size_t layer) {
    std::vector<uint64_t> row(words);
    for (size_t i = layer * corners_.per_layer(); i < (layer + 1) * corners_.per_layer(); ++i) {
      const Slab slab = corners_.at(i);
      for (int v = slab.first_row; v < slab.end_row; ++v) {
        corner_row(v, slab.w, row.data());
        nodes_before_[i] += set_bits(row.data(), words);
      }
    }
    if (static_cast<int>(layer) == voxels_.layers) return;
    for (size_t i = layer * voxels_.per_layer(); i < (layer + 1) * voxels_.per_layer(); ++i) {
      const Slab slab = voxels_.at(i);
      elements_before_[i] = set_bits(mask.row(slab.first_row, slab.w),
                                     words * static_cast<size_t>(slab.end_row - slab.first_row));
    }
  });
  sum_up(elements_before_);
  sum_up(nodes_before_);
  if (nodes() > max_id)
    throw Error(ErrorKind::invalid_input,
                "the mesh would have " + std::to_string(nodes()) +
                    " nodes, and solvers take ids up to 999,999,999; give a smaller "
                    "region or less upsampling");
}

void NodeNumbering::corner_row(int v, int w, uint64_t* words) const {
  const size_t count = mask_.words_per_row();
  std::fill(words, words + count, 0);
  for (int dw = -1; dw <= 0; ++dw)
    for (int dv = -1; dv <= 0; ++dv) {
      if (v + dv < 0 || v + dv >= mask_.dims().y() || w + dw < 0 || w + dw >= mask_.dims().z()) continue;
      const uint64_t* row = mask_.row(v + dv, w + dw);
      for (size_t i = 0; i < count; ++i) words[i] |= row[i];
    }
  uint64_t carried = 0;
  for (size_t i = 0; i < count; ++i) {
    const uint64_t last = words[i] >> 63;
    words[i] |= words[i] << 1 | carried;
    carried = last;
  }
}

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
