#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "fe/voxel_mask.hpp"

namespace ream::fe {

/// Ids of nodes and elements of the mesh of a mask, from 1, without a table of them: the nodes are the set
/// bits of the corner grid (a corner is set when one of its eight voxels is), numbered in its order, x
/// fastest, like the elements in the order of the voxels. Kept are sums before each slab; ids inside follow
/// by counting bits.
class NodeNumbering {
 public:
  /// Abaqus takes no greater ids.
  static constexpr uint64_t max_id = 999'999'999;

  /// The mask must outlive this and stay as it is. On two threads. Throws Error invalid_input when there are
  /// more nodes than ids.
  explicit NodeNumbering(const VoxelMask& mask);

  const VoxelMask& mask() const { return mask_; }
  const Slabs& voxels() const { return voxels_; }
  const Slabs& corners() const { return corners_; }
  uint64_t elements() const { return elements_before_.back(); }
  uint64_t nodes() const { return nodes_before_.back(); }
  /// Elements before a slab of voxels, nodes before a slab of corners.
  uint64_t elements_before(size_t slab) const { return elements_before_[slab]; }
  uint64_t nodes_before(size_t slab) const { return nodes_before_[slab]; }

  /// Which corners of row (v,w) of the corner grid are nodes: mask().words_per_row() words, bit u for the
  /// corner at (u,v,w). Needs 0 <= v <= dims.y, 0 <= w <= dims.z.
  void corner_row(int v, int w, uint64_t* words) const;

 private:
  const VoxelMask& mask_;
  Slabs voxels_, corners_;
  std::vector<uint64_t> elements_before_, nodes_before_;
};

/// One row of corners with the ids of its nodes.
class CornerRow {
 public:
  /// `first_id`: of the row's first node. Returns that of the row after it.
  uint64_t load(const NodeNumbering& numbering, int v, int w, uint64_t first_id) {
    const size_t count = numbering.mask().words_per_row();
    words_.resize(count);
    before_.resize(count);
    numbering.corner_row(v, w, words_.data());
    first_id_ = first_id;
    count_ = 0;
    for (size_t i = 0; i < count; ++i) {
      before_[i] = count_;
      count_ += static_cast<uint32_t>(std::popcount(words_[i]));
    }
    return first_id + count_;
  }

  uint64_t first_id() const { return first_id_; }
  uint32_t count() const { return count_; }
  const std::vector<uint64_t>& words() const { return words_; }
  bool has(int u) const { return (words_[static_cast<size_t>(u) / 64] >> (u % 64) & 1u) != 0; }
  /// Nodes of the row before corner u.
  uint32_t rank(int u) const {
    const size_t i = static_cast<size_t>(u) / 64;
    return before_[i] + static_cast<uint32_t>(std::popcount(words_[i] & ((uint64_t{1} << (u % 64)) - 1)));
  }

 private:
  std::vector<uint64_t> words_;
  std::vector<uint32_t> before_;
  uint64_t first_id_ = 0;
  uint32_t count_ = 0;
};

/// Calls use(v, begin, end, rows) for every run of elements in a slab of voxels, in order; rows are the four
/// corner rows around them: (v,w), (v+1,w), (v,w+1), (v+1,w+1). `Row` is CornerRow or has its load().
template <typename Row, typename Use>
void for_each_element_run(const NodeNumbering& numbering, size_t slab_number, Use&& use) {
  const Slab slab = numbering.voxels().at(slab_number);
  const size_t across = static_cast<size_t>(slab.first_row / numbering.corners().rows_per_slab);
  uint64_t next_id[2];
  for (size_t k = 0; k < 2; ++k)
    next_id[k] = 1 + numbering.nodes_before(
                         (static_cast<size_t>(slab.w) + k) * numbering.corners().per_layer() + across);
  Row rows[4];  // (v, w), (v + 1, w), (v, w + 1), (v + 1, w + 1)
  for (int k = 0; k < 2; ++k)
    next_id[k] = rows[2 * k + 1].load(numbering, slab.first_row, slab.w + k, next_id[k]);
  for (int v = slab.first_row; v < slab.end_row; ++v) {
    for (int k = 0; k < 2; ++k) {
      std::swap(rows[2 * k], rows[2 * k + 1]);
      next_id[k] = rows[2 * k + 1].load(numbering, v + 1, slab.w + k, next_id[k]);
    }
    for_each_run(numbering.mask().row(v, slab.w), numbering.mask().words_per_row(),
                 [&](int begin, int end) { use(v, begin, end, rows); });
  }
}

/// Calls use(v, row) for every row of a slab of corners, in order.
template <typename Use>
void for_each_corner_row(const NodeNumbering& numbering, size_t slab_number, Use&& use) {
  const Slab slab = numbering.corners().at(slab_number);
  uint64_t next_id = 1 + numbering.nodes_before(slab_number);
  CornerRow row;
  for (int v = slab.first_row; v < slab.end_row; ++v) {
    next_id = row.load(numbering, v, slab.w, next_id);
    use(v, slab.w, row);
  }
}

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
