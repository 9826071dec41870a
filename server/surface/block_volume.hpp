#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "surface/block_layout.hpp"
#include "voxel/voxel_grid.hpp"

namespace ream::surface {

/// Bits first..last.
constexpr uint64_t bits(int first, int last) {
  return (~uint64_t{0} << first) & (~uint64_t{0} >> (63 - last));
}

/// Coverage of one block as marching cubes wants it: samples -2 to cells + 1 around the block's own, in rows
/// of x, 0 outside the grid. At stride 1 samples are voxels, otherwise the coarse_samples().
/// Working memory, used for one block after another.
class BlockVolume {
 public:
  static constexpr int margin_x = 8, margin = 2;  ///< place of the block's first sample in a row, and in y, z
  static constexpr int row_bytes = block_edge + 2 * margin_x;
  static constexpr int edge = block_edge + 2 * margin;  ///< rows a slice and slices, at stride 1
  static constexpr int slice_bytes = row_bytes * edge;

  BlockVolume(const voxel::VoxelGrid& grid, int stride);

  /// False when the block holds no surface.
  bool load(const uint8_t* coverage, const Vec3i& block);

  int stride() const { return stride_; }
  /// Cells along each edge.
  int cells() const { return block_edge / stride_; }
  const uint8_t* row(int y, int z) const { return samples_.data() + z * slice_bytes + y * row_bytes; }
  /// Bit x is set where the sample is filled, 128 or more.
  uint64_t filled(int y, int z) const { return filled_[static_cast<size_t>(z * edge + y)]; }
  /// First and last corner of the block's cells. The blocks at the grid's minimum sides own the cells before
  /// their first sample too.
  const Vec3i& low() const { return low_; }
  const Vec3i& last() const { return last_; }

 private:
  void load_voxels(const uint8_t* coverage, const Vec3i& block);
  void load_coarse(const uint8_t* coverage, const Vec3i& block);
  bool find_filled();

  voxel::VoxelGrid grid_;
  int stride_;
  Vec3i low_ = Vec3i::Zero(), last_ = Vec3i::Zero();
  std::vector<uint8_t> samples_;
  std::vector<uint64_t> filled_;
};

/// Coarse samples for slow links: sample i of an axis stands for the `stride` (2 or 4) voxels from i * stride
/// on. Its value is their mean, which puts surfaces where they are, sub-voxel and smooth. A wall thinner than
/// half a sample would vanish from means though, and reaming leaves such walls; so where voxels are filled
/// but neither the sample nor any of its 26 neighbours has a filled mean, the value is that of the fullest
/// voxel. (Around thicker bone the means say enough: beside a plane surface of any tilt, every sample that
/// holds a filled voxel has a neighbour with a filled mean.)
///
/// Writes edge^3 samples, x fastest, from sample `block_first` - 2 on in each axis; 0 outside the grid.
void coarse_samples(const voxel::VoxelGrid& grid, const uint8_t* coverage, const Vec3i& block_first, int edge,
                    int stride, uint8_t* samples, int row_bytes, int slice_bytes);

}  // namespace ream::surface
