#pragma once
#include <cstdint>
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
  static constexpr uint64_t greatest_id = 999'999'999;

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

}  // namespace ream::fe
